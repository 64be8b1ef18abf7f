#include "shape_rows.hpp"

namespace mpm::scene {

std::optional<Defect> Box::defect(int dimensions) const
{
  return box_defect(lower, upper, dimensions);
}

const std::vector<Parameter<Box>>& Box::rows()
{
  static const std::vector<Parameter<Box>> list{
      member<Box>("lower", &Box::lower, coordinates,
                  "lower left corner [x, y], in space [x, y, z]"),
      member<Box>("upper", &Box::upper, coordinates, "upper right corner"),
  };
  return list;
}

}  // namespace mpm::scene
