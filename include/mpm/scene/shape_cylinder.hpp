#pragma once
/// A full or hollow cylinder.

#include <mpm/scene/shape_kind.hpp>

#include <string_view>

namespace mpm::scene {

struct Cylinder {
  static constexpr std::string_view keyword = "cylinder";
  static constexpr std::string_view help = "full or hollow, in any direction, with plane ends";
  static constexpr bool in_plane = false, in_space = true;
  Point<3> from{}, to{};    ///< m, centres of the ends
  double radius = 0;        ///< m
  double inner_radius = 0;  ///< m, 0: full

  /// The first end belongs to it, the last one does not; neither does the inner surface.
  bool contains(const Point<3>& point) const;
  Extent extent() const;
  std::optional<Defect> defect(int dimensions) const;
  static const std::vector<Parameter<Cylinder>>& rows();
  bool operator==(const Cylinder&) const = default;
};

}  // namespace mpm::scene
