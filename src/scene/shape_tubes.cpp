#include "shape_rows.hpp"

namespace mpm::scene {

namespace {

/// The two axes across a third, ascending.
constexpr std::array<std::array<std::size_t, 2>, 3> across{{{1, 2}, {0, 2}, {0, 1}}};

}  // namespace

Honeycomb Tubes::section() const
{
  const auto [a, b] = across[std::size_t(axis)];
  return {{lower[a], lower[b]}, {upper[a], upper[b]}, cell_side, wall_thickness};
}

bool Tubes::contains(const Point<3>& point) const
{
  const auto along = std::size_t(axis);
  if (point[along] < lower[along] || point[along] >= upper[along]) return false;
  const auto [a, b] = across[along];
  return section().contains({point[a], point[b]});
}

Extent Tubes::extent() const
{
  return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
}

std::optional<Defect> Tubes::defect(int) const
{
  if (const auto defect = section().defect(2); defect && defect->key != "upper") return defect;
  return box_defect(lower, upper, 3);
}

const std::vector<Parameter<Tubes>>& Tubes::rows()
{
  using T = Tubes;
  static const std::vector<Parameter<T>> list{
      member<T>("lower", &T::lower, coordinates, "lower corner [x, y, z]"),
      member<T>("upper", &T::upper, coordinates, "upper corner [x, y, z]"),
      member<T>("cell_side", &T::cell_side, scene::extent,
                "centre-line length of a hexagon's side"),
      member<T>("wall_thickness", &T::wall_thickness, scene::extent, "thickness of the walls"),
      member<T>("axis", &T::axis, {},
                "along the tubes; across it two sides of each hexagon stand along the later axis"),
  };
  return list;
}

}  // namespace mpm::scene
