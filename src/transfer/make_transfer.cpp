#include "make_transfer.hpp"

#include <mpm/shape/shape_types.hpp>

namespace mpm {

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(OneOf<ShapeRow> shape, OneOf<SchemeRow> scheme,
                                             int particles_per_cell, bool f_bar)
{
  std::unique_ptr<Transfer<Dim>> made;
  for_each_type(ShapeTypes{}, [&]<class Shape>() {
    if (shape == Shape::row.keyword)
      made = make_shape_transfer<Dim, Shape>(scheme, particles_per_cell, f_bar);
  });
  return made;
}

template std::unique_ptr<Transfer<2>> make_transfer(OneOf<ShapeRow>, OneOf<SchemeRow>, int, bool);
template std::unique_ptr<Transfer<3>> make_transfer(OneOf<ShapeRow>, OneOf<SchemeRow>, int, bool);

}  // namespace mpm
