#include "shape_rows.hpp"

namespace mpm::scene {

Extent Disc::extent() const
{
  return {{centre[0] - radius, centre[1] - radius}, {centre[0] + radius, centre[1] + radius}};
}

const std::vector<Parameter<Disc>>& Disc::rows()
{
  static const std::vector<Parameter<Disc>> list{
      member<Disc>("centre", &Disc::centre, coordinates, "[x, y]"),
      member<Disc>("radius", &Disc::radius, scene::extent, "radius"),
  };
  return list;
}

}  // namespace mpm::scene
