#pragma once
#include <mpm/transfer/kernel_transfer.hpp>
#include <mpm/transfer/scheme_types.hpp>

#include "make_transfer.hpp"

namespace mpm {

template <int Dim, class Shape>
std::unique_ptr<Transfer<Dim>> make_shape_transfer(OneOf<SchemeRow> scheme, int particles_per_cell,
                                                   bool f_bar)
{
  std::unique_ptr<Transfer<Dim>> made;
  for_each_type(SchemeTypes{}, [&]<class Scheme>() {
    if (scheme == Scheme::row.keyword)
      made = std::make_unique<KernelTransfer<Dim, Shape, Scheme>>(Shape::make(particles_per_cell),
                                                                  f_bar);
  });
  return made;
}

}  // namespace mpm
