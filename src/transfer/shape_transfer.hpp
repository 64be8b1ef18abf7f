#pragma once
#include <mpm/transfer/kernel_transfer.hpp>
#include <mpm/transfer/scheme_types.hpp>

#include "make_transfer.hpp"

namespace mpm {

/// The kernels know of a scheme no more than this, and are compiled once for those that agree in
/// it.
template <bool Increments, bool Affine, bool ShapeGradient>
struct SchemeKernels {
  static constexpr bool increments = Increments, affine = Affine, shape_gradient = ShapeGradient;
};
template <class Scheme>
using Kernels = SchemeKernels<Scheme::increments, Scheme::affine, Scheme::shape_gradient>;

template <int Dim, class Shape>
std::unique_ptr<Transfer<Dim>> make_shape_transfer(OneOf<SchemeRow> scheme,
                                                   const TransferOptions& options)
{
  std::unique_ptr<Transfer<Dim>> made;
  for_each_type(SchemeTypes{}, [&]<class Scheme>() {
    if (scheme == Scheme::row.keyword)
      made = std::make_unique<KernelTransfer<Dim, Shape, Kernels<Scheme>>>(options);
  });
  return made;
}

}  // namespace mpm
