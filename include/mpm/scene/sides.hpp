#pragma once
/// What the sides of a scene's grid are.

#include <mpm/scene/scene.hpp>

#include <optional>

namespace mpm::scene {

/// None for piston and fixed edge.
std::optional<Lateral> side_of(const Scene& scene, int axis, bool upper);

/// Whether what leaves along an axis comes in at its other side.
bool is_periodic(const Scene& scene, int axis);

}  // namespace mpm::scene
