#include <cmath>
#include <numbers>

#include "shape_rows.hpp"

namespace mpm::scene {

using std::numbers::sqrt3;

bool Honeycomb::contains(const Point<2>& point) const
{
  for (std::size_t d = 0; d < 2; ++d)
    if (point[d] < lower[d] || point[d] >= upper[d]) return false;
  const double side = cell_side;
  // Centres lie on two rectangular lattices, the second in the middle of the first. A point belongs
  // to the hexagon whose centre is nearest.
  const Point<2> period{sqrt3 * side, 3 * side};
  const double x = point[0] - lower[0], y = point[1] - lower[1];
  const double x1 = x - period[0] * std::round(x / period[0]);
  const double y1 = y - period[1] * std::round(y / period[1]);
  const double x2 = std::abs(x1) - 0.5 * period[0], y2 = std::abs(y1) - 0.5 * period[1];
  const bool first = x1 * x1 + y1 * y1 <= x2 * x2 + y2 * y2;
  const double dx = std::abs(first ? x1 : x2), dy = std::abs(first ? y1 : y2);

  // Towards the nearest side: straight to the right, or 60 degrees up.
  const double apothem = 0.5 * sqrt3 * side;
  const double towards_side = std::max(dx, 0.5 * dx + 0.5 * sqrt3 * dy);
  return apothem - towards_side <= 0.5 * wall_thickness;
}

Extent Honeycomb::extent() const
{
  return {{lower[0], lower[1]}, {upper[0], upper[1]}};
}

std::optional<Defect> Honeycomb::defect(int) const
{
  if (wall_thickness >= sqrt3 * cell_side)
    return Defect{"wall_thickness", "must be below sqrt(3) cell_side, or no lumen is left"};
  return box_defect(lower, upper, 2);
}

double Honeycomb::relative_density() const
{
  const double opening = 1 - wall_thickness / (sqrt3 * cell_side);
  return 1 - opening * opening;
}

const std::vector<Parameter<Honeycomb>>& Honeycomb::rows()
{
  using H = Honeycomb;
  static const std::vector<Parameter<H>> list{
      member<H>("lower", &H::lower, coordinates, "lower left corner [x, y]"),
      member<H>("upper", &H::upper, coordinates, "upper right corner [x, y]"),
      member<H>("cell_side", &H::cell_side, scene::extent,
                "centre-line length of a hexagon's side"),
      member<H>("wall_thickness", &H::wall_thickness, scene::extent, "thickness of the walls"),
  };
  return list;
}

}  // namespace mpm::scene
