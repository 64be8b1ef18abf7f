#pragma once
#include <mpm/core/error.hpp>
#include <mpm/transfer/kernel_transfer.hpp>

namespace mpm {

/// The transfer schemes, each compiled with one shape function.
template <int Dim, class Shape>
std::unique_ptr<Transfer<Dim>> make_scheme(SchemeKind scheme, Shape shape)
{
  switch (scheme) {
    case SchemeKind::flip:
      return std::make_unique<KernelTransfer<Dim, Shape, Flip>>(shape);
    case SchemeKind::pic:
      return std::make_unique<KernelTransfer<Dim, Shape, Pic>>(shape);
    case SchemeKind::apic:
      return std::make_unique<KernelTransfer<Dim, Shape, Apic>>(shape);
    case SchemeKind::tpic:
      return std::make_unique<KernelTransfer<Dim, Shape, Tpic>>(shape);
  }
  throw InputError("unknown transfer scheme");
}

}  // namespace mpm
