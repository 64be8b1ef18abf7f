#include <limits>

#include "shape_rows.hpp"

namespace mpm::scene {

bool Polygon::contains(const Point<2>& point) const
{
  const auto [x, y] = point;
  bool inside = false;
  Point<2> a = vertices.back();
  for (const Point<2>& b : vertices) {
    // Count the sides that a ray to the right crosses. A vertex on the ray counts as above it.
    // From the lower end, so that a side shared by two polygons is one and the same line.
    const Point<2>&low = a[1] < b[1] ? a : b, &high = a[1] < b[1] ? b : a;
    if ((low[1] > y) != (high[1] > y) &&
        x < low[0] + (high[0] - low[0]) * (y - low[1]) / (high[1] - low[1]))
      inside = !inside;
    a = b;
  }
  return inside;
}

Extent Polygon::extent() const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Extent box{{infinity, infinity}, {-infinity, -infinity}};
  for (const Point<2>& vertex : vertices)
    for (std::size_t d = 0; d < 2; ++d) {
      box.lower[d] = std::min(box.lower[d], vertex[d]);
      box.upper[d] = std::max(box.upper[d], vertex[d]);
    }
  return box;
}

std::optional<Defect> Polygon::defect(int) const
{
  if (vertices.size() < 3) return Defect{"vertices", "a polygon has at least 3 vertices"};
  return std::nullopt;
}

const std::vector<Parameter<Polygon>>& Polygon::rows()
{
  static const std::vector<Parameter<Polygon>> list{
      member<Polygon>("vertices", &Polygon::vertices, coordinates, "list of corners [x, y]"),
  };
  return list;
}

}  // namespace mpm::scene
