#pragma once
/// Update orders: which passes and sums a step makes, and when it updates stress and velocity. Each
/// is a type with `row` and `step(Step& s, double dt)`, where Step is stepping/step.hpp's, from
/// which an order takes everything. Between steps the grid holds the sums of the particles' present
/// state, so that every step begins with the grid update and ends with particles complete in
/// position, velocity and stress. (Sulsky, Zhou & Schreyer 1995, CPC 87:236; Bardenhagen 2002, JCP
/// 180:383; Nairn 2003, CMES 4:649.)

#include <mpm/shape/shape_row.hpp>

#include <string_view>

namespace mpm {

struct UpdateOrderRow {
  std::string_view keyword;
  std::string_view help;
  std::string_view words;  ///< in the plan of a run
  /// Whether new particle velocities are mapped back: the nodes then hold that momentum, and the
  /// particles the grid's velocity until they move.
  bool remaps = false;
  /// Whether the sums between steps hold the internal force.
  bool begins_with_force = true;
  /// When a step leaves the stresses, counted from the moment of the velocities, in steps
  /// (leap-frog).
  double stress_moment = 0.5;
  /// Of the order; without one the scheme's holds.
  std::optional<double> StableCfl::*stable_cfl = nullptr;
};

}  // namespace mpm
