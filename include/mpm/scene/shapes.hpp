#pragma once
/// The shapes that a specimen can be made of. A new one is a word in `Geometry`.

#include <mpm/scene/shape_box.hpp>
#include <mpm/scene/shape_cylinder.hpp>
#include <mpm/scene/shape_disc.hpp>
#include <mpm/scene/shape_honeycomb.hpp>
#include <mpm/scene/shape_polygon.hpp>
#include <mpm/scene/shape_sphere.hpp>
#include <mpm/scene/shape_tubes.hpp>

#include <type_traits>
#include <utility>
#include <variant>

namespace mpm::scene {

using Geometry = std::variant<Box, Disc, Polygon, Honeycomb, Sphere, Cylinder, Tubes>;

struct Shape {
  Geometry geometry;
  std::string material;        ///< name; "void" cuts a hole in earlier shapes
  PerAxis<double> velocity{};  ///< m/s, initial
  bool operator==(const Shape&) const = default;
};

/// Visits every kind of shape, in the order of the list, with a std::type_identity of it.
template <class Visit>
void for_each_kind(Visit visit)
{
  [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
    (visit(std::type_identity<Kinds>{}), ...);
  }(std::type_identity<Geometry>{});
}

/// The keywords of the shapes for scenes of so many dimensions.
std::vector<std::string> shape_keywords(int dimensions);

}  // namespace mpm::scene
