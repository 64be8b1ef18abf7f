#include "shape_rows.hpp"

namespace mpm::scene {

Extent Sphere::extent() const
{
  Extent box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lower[d] = centre[d] - radius;
    box.upper[d] = centre[d] + radius;
  }
  return box;
}

const std::vector<Parameter<Sphere>>& Sphere::rows()
{
  static const std::vector<Parameter<Sphere>> list{
      member<Sphere>("centre", &Sphere::centre, coordinates, "[x, y, z]"),
      member<Sphere>("radius", &Sphere::radius, scene::extent, "radius"),
  };
  return list;
}

}  // namespace mpm::scene
