#pragma once
/// A rectangle or cuboid.

#include <mpm/scene/shape_kind.hpp>

#include <string_view>

namespace mpm::scene {

struct Box {
  static constexpr std::string_view keyword = "box";
  static constexpr std::string_view help = "rectangle, in space cuboid";
  static constexpr bool in_plane = true, in_space = true;
  PerAxis<double> lower{}, upper{};  ///< m

  /// The lower ends belong to it, the upper ones do not: neighbours share no point.
  template <std::size_t Dim>
  bool contains(const std::array<double, Dim>& point) const
  {
    bool inside = true;
    for (std::size_t d = 0; d < Dim; ++d)
      inside = inside && point[d] >= lower[d] && point[d] < upper[d];
    return inside;
  }
  Extent extent() const { return {lower, upper}; }
  std::optional<Defect> defect(int dimensions) const;
  static const std::vector<Parameter<Box>>& rows();
  bool operator==(const Box&) const = default;
};

}  // namespace mpm::scene
