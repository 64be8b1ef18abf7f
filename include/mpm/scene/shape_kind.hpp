#pragma once
/// What every shape of a specimen brings. A new one is a pair of files shape_NAME, a name in
/// `Geometry` (shapes.hpp) and a test; keys, messages, reference page and rastering follow.
///
/// A shape is a struct with
///   keyword, help             its key in the scene, and what it is
///   in_plane, in_space        the scenes that it can be part of
///   contains(Point<Dim>)      whether a point (m, from the specimen's lower corner) is inside
///   extent()                  the smallest upright box around it
///   defect(dimensions)        what makes it meaningless, if anything
///   rows()                    its keys
///   operator==

#include <mpm/scene/plane_or_space.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mpm::scene {

template <class Owner>
struct Parameter;

/// An upright box, m. In the plane the third axis means nothing.
struct Extent {
  PerAxis<double> lower{}, upper{};
};

/// What is impossible about a shape: the key, and the reason (`must be below 2 um`).
struct Defect {
  std::string key, reason;
};

/// Whether shapes of this kind can be part of a scene of so many dimensions.
template <class Kind>
constexpr bool lies_in(int dimensions)
{
  return dimensions == 2 ? Kind::in_plane : Kind::in_space;
}

}  // namespace mpm::scene
