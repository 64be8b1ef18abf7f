#pragma once

namespace mpm {

/// What a pass adds to the nodes.
struct ScatterContent {
  bool mass = false, momentum = false, force = false, remap = false;
};

/// What a pass does, in this order.
struct PassContent {
  bool refine = false;       ///< G2P of the residual velocity, and nothing else
  bool gradient = false;     ///< velocity gradient at the old place, stress update
  bool half_stress = false;  ///< by half of the step
  bool velocity = false;     ///< G2P of the velocity
  bool move = false;
  bool one_displacement = false;  ///< the move is by the velocity whose gradient is taken
  ScatterContent scatter;         ///< P2G at the new place
};

}  // namespace mpm
