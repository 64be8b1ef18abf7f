#include <mpm/shape/shape_types.hpp>
#include <mpm/shape/shapes.hpp>

namespace mpm {

template <>
std::span<const ShapeRow> list_of<ShapeRow>()
{
  return rows_of<ShapeRow>(ShapeTypes{});
}

}  // namespace mpm
