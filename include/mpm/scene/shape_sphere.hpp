#pragma once
/// A full sphere.

#include <mpm/scene/shape_kind.hpp>

#include <string_view>

namespace mpm::scene {

struct Sphere {
  static constexpr std::string_view keyword = "sphere";
  static constexpr std::string_view help = "full sphere";
  static constexpr bool in_plane = false, in_space = true;
  Point<3> centre{};  ///< m
  double radius = 0;  ///< m

  bool contains(const Point<3>& point) const
  {
    double squares = 0;
    for (std::size_t d = 0; d < 3; ++d) squares += (point[d] - centre[d]) * (point[d] - centre[d]);
    return squares <= radius * radius;
  }
  Extent extent() const;
  std::optional<Defect> defect(int) const { return std::nullopt; }
  static const std::vector<Parameter<Sphere>>& rows();
  bool operator==(const Sphere&) const = default;
};

}  // namespace mpm::scene
