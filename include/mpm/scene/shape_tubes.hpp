#pragma once
/// A bundle of hexagonal tubes, like the tracheids of softwood.

#include <mpm/scene/shape_honeycomb.hpp>

namespace mpm::scene {

enum class Axis { x, y, z };

/// The walls of a honeycomb drawn out along an axis.
struct Tubes {
  static constexpr std::string_view keyword = "tubes";
  static constexpr std::string_view help =
      "bundle of hexagonal tubes: walls of a honeycomb drawn out along an axis";
  static constexpr bool in_plane = false, in_space = true;
  Point<3> lower{}, upper{};  ///< m
  double cell_side = 0;       ///< m, centre-line length of a hexagon's side
  double wall_thickness = 0;  ///< m
  Axis axis = Axis::z;        ///< along the tubes

  /// Inside the box, and in the section across the axis inside the honeycomb; the section's
  /// coordinates are the two other axes, ascending.
  bool contains(const Point<3>& point) const;
  Extent extent() const;
  std::optional<Defect> defect(int dimensions) const;
  static const std::vector<Parameter<Tubes>>& rows();
  bool operator==(const Tubes&) const = default;

  Honeycomb section() const;
};

}  // namespace mpm::scene
