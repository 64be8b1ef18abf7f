#include "make_transfer.hpp"

#include <mpm/shape/shape_types.hpp>

namespace mpm {

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(OneOf<ShapeRow> shape, OneOf<SchemeRow> scheme,
                                             const TransferOptions& options)
{
  std::unique_ptr<Transfer<Dim>> made;
  for_each_type(ShapeTypes{}, [&]<class Shape>() {
    if (shape == Shape::row.keyword) made = make_shape_transfer<Dim, Shape>(scheme, options);
  });
  return made;
}

template std::unique_ptr<Transfer<2>> make_transfer(OneOf<ShapeRow>, OneOf<SchemeRow>,
                                                    const TransferOptions&);
template std::unique_ptr<Transfer<3>> make_transfer(OneOf<ShapeRow>, OneOf<SchemeRow>,
                                                    const TransferOptions&);

}  // namespace mpm
