#pragma once
/// A polygon, closed by itself.

#include <mpm/scene/shape_kind.hpp>

#include <string_view>

namespace mpm::scene {

struct Polygon {
  static constexpr std::string_view keyword = "polygon";
  static constexpr std::string_view help = "closed by itself, inside by the even-odd rule";
  static constexpr bool in_plane = true, in_space = false;
  std::vector<Point<2>> vertices;  ///< m

  /// Even-odd rule: an outline that crosses itself leaves holes. Polygons that share an edge share
  /// no point and leave none out.
  bool contains(const Point<2>& point) const;
  Extent extent() const;
  std::optional<Defect> defect(int dimensions) const;
  static const std::vector<Parameter<Polygon>>& rows();
  bool operator==(const Polygon&) const = default;
};

}  // namespace mpm::scene
