#pragma once
/// Where a scene's parts lie, for those who build the run from it.

#include <mpm/micrograph/specimen.hpp>
#include <mpm/scene/scene.hpp>

#include <array>
#include <cstddef>

namespace mpm {

inline int axis_of(scene::Side side)
{
  return side == scene::Side::left || side == scene::Side::right ? 0 : 1;
}
inline bool upper_of(scene::Side side)
{
  return side == scene::Side::right || side == scene::Side::top;
}

/// Initial velocity of the particle at a location, m/s.
std::array<double, 2> initial_velocity(const scene::Scene& scene,
                                       const micrograph::Lattice& lattice, std::size_t location);

/// The load cell: elastic like the first deformable material, stiffer and denser by the same
/// ratio, so that waves run through it as fast as through the wood.
scene::Material load_cell_material(const scene::Scene& scene, double ratio);

}  // namespace mpm
