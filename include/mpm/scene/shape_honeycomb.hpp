#pragma once
/// Walls of regular hexagons.

#include <mpm/scene/shape_kind.hpp>

#include <string_view>

namespace mpm::scene {

/// Regular hexagonal honeycomb that fills the box.
struct Honeycomb {
  static constexpr std::string_view keyword = "honeycomb";
  static constexpr std::string_view help = "regular hexagons that fill a rectangle";
  static constexpr bool in_plane = true, in_space = false;
  Point<2> lower{}, upper{};  ///< m
  double cell_side = 0;       ///< m, centre-line length of a hexagon's side
  double wall_thickness = 0;  ///< m

  /// Inside the box and within half a wall thickness of a side of a hexagon. One hexagon is centred
  /// on the box's lower corner; two sides of each are vertical. The box's left and lower edges are
  /// thus mirror lines, and so are the others where the width is a multiple of sqrt(3)/2 side and
  /// the height of 3/2 side.
  bool contains(const Point<2>& point) const;
  Extent extent() const;
  std::optional<Defect> defect(int dimensions) const;
  static const std::vector<Parameter<Honeycomb>>& rows();
  bool operator==(const Honeycomb&) const = default;

  /// Of the periodic honeycomb with side l and wall t: 1 - (1 - t / (sqrt(3) l))^2.
  double relative_density() const;
};

}  // namespace mpm::scene
