#include <mpm/micrograph/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace mpm::micrograph {

using std::numbers::sqrt3;

bool contains(const scene::Box& box, const Point& point)
{
  return point[0] >= box.lower[0] && point[0] < box.upper[0] &&  //
         point[1] >= box.lower[1] && point[1] < box.upper[1];
}

bool contains(const scene::Disc& disc, const Point& point)
{
  const double dx = point[0] - disc.centre[0], dy = point[1] - disc.centre[1];
  return dx * dx + dy * dy <= disc.radius * disc.radius;
}

bool contains(const scene::Polygon& polygon, const Point& point)
{
  const auto [x, y] = point;
  bool inside = false;
  Point a = polygon.vertices.back();
  for (const Point& b : polygon.vertices) {
    // Count the sides that a ray to the right crosses. A vertex on the ray counts as above it.
    // From the lower end, so that a side shared by two polygons is one and the same line.
    const Point &low = a[1] < b[1] ? a : b, &high = a[1] < b[1] ? b : a;
    if ((low[1] > y) != (high[1] > y) &&
        x < low[0] + (high[0] - low[0]) * (y - low[1]) / (high[1] - low[1]))
      inside = !inside;
    a = b;
  }
  return inside;
}

bool contains(const scene::Honeycomb& honeycomb, const Point& point)
{
  if (!contains(scene::Box{honeycomb.lower, honeycomb.upper}, point)) return false;
  const double side = honeycomb.cell_side;
  // Centres lie on two rectangular lattices, the second in the middle of the first. A point belongs
  // to the hexagon whose centre is nearest.
  const Point period{sqrt3 * side, 3 * side};
  const double x = point[0] - honeycomb.lower[0], y = point[1] - honeycomb.lower[1];
  const double x1 = x - period[0] * std::round(x / period[0]);
  const double y1 = y - period[1] * std::round(y / period[1]);
  const double x2 = std::abs(x1) - 0.5 * period[0], y2 = std::abs(y1) - 0.5 * period[1];
  const bool first = x1 * x1 + y1 * y1 <= x2 * x2 + y2 * y2;
  const double dx = std::abs(first ? x1 : x2), dy = std::abs(first ? y1 : y2);

  // Towards the nearest side: straight to the right, or 60 degrees up.
  const double apothem = 0.5 * sqrt3 * side;
  const double towards_side = std::max(dx, 0.5 * dx + 0.5 * sqrt3 * dy);
  return apothem - towards_side <= 0.5 * honeycomb.wall_thickness;
}

namespace {

struct Bounds {
  scene::Box operator()(const scene::Box& box) const { return box; }
  scene::Box operator()(const scene::Disc& disc) const
  {
    const auto [x, y] = disc.centre;
    const double r = disc.radius;
    return {{x - r, y - r}, {x + r, y + r}};
  }
  scene::Box operator()(const scene::Polygon& polygon) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    scene::Box box{{infinity, infinity}, {-infinity, -infinity}};
    for (const Point& vertex : polygon.vertices)
      for (std::size_t d = 0; d < 2; ++d) {
        box.lower[d] = std::min(box.lower[d], vertex[d]);
        box.upper[d] = std::max(box.upper[d], vertex[d]);
      }
    return box;
  }
  scene::Box operator()(const scene::Honeycomb& honeycomb) const
  {
    return {honeycomb.lower, honeycomb.upper};
  }
};

struct Defect {
  std::string operator()(const scene::Box& box) const
  {
    for (std::size_t d = 0; d < 2; ++d)
      if (!(box.lower[d] < box.upper[d]))
        return fmt::format("lower[{}] is {} m and upper[{}] is {} m (lower must be below upper)", d,
                           box.lower[d], d, box.upper[d]);
    return {};
  }
  std::string operator()(const scene::Disc& disc) const
  {
    if (!(disc.radius > 0)) return fmt::format("radius is {} m (must be above 0)", disc.radius);
    return {};
  }
  std::string operator()(const scene::Polygon& polygon) const
  {
    if (polygon.vertices.size() < 3)
      return fmt::format("vertices are {} (a polygon needs at least 3)", polygon.vertices.size());
    return {};
  }
  std::string operator()(const scene::Honeycomb& honeycomb) const
  {
    const auto [lower, upper, side, wall] = honeycomb;
    if (!(side > 0)) return fmt::format("cell_side is {} m (must be above 0)", side);
    if (!(wall > 0 && wall < sqrt3 * side))
      return fmt::format("wall_thickness is {} m (must lie between 0 and sqrt(3) cell_side = {} m)",
                         wall, sqrt3 * side);
    return (*this)(scene::Box{lower, upper});
  }
};

}  // namespace

scene::Box bounds(const scene::Shape& shape)
{
  return std::visit(Bounds{}, shape.geometry);
}

std::string defect(const scene::Shape& shape)
{
  return std::visit(Defect{}, shape.geometry);
}

double relative_density(const scene::Honeycomb& honeycomb)
{
  const double opening = 1 - honeycomb.wall_thickness / (sqrt3 * honeycomb.cell_side);
  return 1 - opening * opening;
}

}  // namespace mpm::micrograph
