#pragma once
#include <mpm/transfer/kernel_transfer.hpp>
#include <mpm/transfer/scheme_types.hpp>

#include "make_transfer.hpp"

namespace mpm {

template <int Dim, class Shape>
std::unique_ptr<Transfer<Dim>> make_shape_transfer(OneOf<SchemeRow> scheme,
                                                   const TransferOptions& options)
{
  std::unique_ptr<Transfer<Dim>> made;
  for_each_type(SchemeTypes{}, [&]<class Scheme>() {
    if (scheme != Scheme::row.keyword) return;
    if constexpr (Scheme::increments)
      if (options.pic_share > 0) {
        constexpr bool blends = true;
        made = std::make_unique<KernelTransfer<Dim, Shape, Kernels<Scheme, blends>>>(options);
        return;
      }
    made = std::make_unique<KernelTransfer<Dim, Shape, Kernels<Scheme>>>(options);
  });
  return made;
}

}  // namespace mpm
