#pragma once
/// A full circle.

#include <mpm/scene/shape_kind.hpp>

#include <string_view>

namespace mpm::scene {

struct Disc {
  static constexpr std::string_view keyword = "disc";
  static constexpr std::string_view help = "full circle";
  static constexpr bool in_plane = true, in_space = false;
  Point<2> centre{};  ///< m
  double radius = 0;  ///< m

  bool contains(const Point<2>& point) const
  {
    const double dx = point[0] - centre[0], dy = point[1] - centre[1];
    return dx * dx + dy * dy <= radius * radius;
  }
  Extent extent() const;
  std::optional<Defect> defect(int) const { return std::nullopt; }
  static const std::vector<Parameter<Disc>>& rows();
  bool operator==(const Disc&) const = default;
};

}  // namespace mpm::scene
