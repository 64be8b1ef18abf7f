#include <cmath>

#include "shape_rows.hpp"

namespace mpm::scene {

bool Cylinder::contains(const Point<3>& point) const
{
  double length_squared = 0, along = 0, distance_squared = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double axis = to[d] - from[d], arm = point[d] - from[d];
    length_squared += axis * axis;
    along += axis * arm;
    distance_squared += arm * arm;
  }
  if (along < 0 || along >= length_squared) return false;
  const double from_axis_squared = distance_squared - along * along / length_squared;
  return from_axis_squared <= radius * radius &&
         (inner_radius == 0 || from_axis_squared > inner_radius * inner_radius);
}

Extent Cylinder::extent() const
{
  double length_squared = 0;
  for (std::size_t d = 0; d < 3; ++d) length_squared += (to[d] - from[d]) * (to[d] - from[d]);
  Extent box;
  for (std::size_t d = 0; d < 3; ++d) {
    // How far a circle across the axis reaches along d.
    const double axis = to[d] - from[d];
    const double reach = radius * std::sqrt(std::max(0.0, 1 - axis * axis / length_squared));
    box.lower[d] = std::min(from[d], to[d]) - reach;
    box.upper[d] = std::max(from[d], to[d]) + reach;
  }
  return box;
}

std::optional<Defect> Cylinder::defect(int) const
{
  if (from == to) return Defect{"to", "is the same point as from"};
  if (inner_radius >= radius) return Defect{"inner_radius", "must be below radius"};
  return std::nullopt;
}

const std::vector<Parameter<Cylinder>>& Cylinder::rows()
{
  using C = Cylinder;
  static const std::vector<Parameter<C>> list{
      member<C>("from", &C::from, coordinates, "centre of one end [x, y, z]"),
      member<C>("to", &C::to, coordinates, "centre of the other end [x, y, z]"),
      member<C>("radius", &C::radius, scene::extent, "outer radius"),
      member<C>("inner_radius", &C::inner_radius,
                {.quantity = Quantity::length, .bound = at_least(0)}, "of the hole; 0: none"),
  };
  return list;
}

}  // namespace mpm::scene
