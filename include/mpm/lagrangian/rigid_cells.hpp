#pragma once
/// Bodies of a total Lagrangian step that cannot be deformed.

#include <mpm/conditions/wall_motion.hpp>
#include <mpm/core/types.hpp>

#include <array>
#include <string>
#include <vector>

namespace mpm {

/// The cells of one that this rank has. Their corners move as they are told; contact presses on
/// them as on any other cell's, with the stiffness of what they meet.
template <int Dim>
struct RigidCells {
  std::string name;
  std::vector<IndexVec<Dim>> locations;
  std::array<WallMotion, Dim> motion;  ///< along each axis
};

}  // namespace mpm
