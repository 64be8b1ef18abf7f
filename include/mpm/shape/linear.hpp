#pragma once
#include <mpm/core/lanes.hpp>
#include <mpm/shape/shape_row.hpp>

namespace mpm {

/// Linear (hat) functions: 2 nodes per axis. Gradients jump at cell boundaries ("cell crossing").
///
/// Every shape function has the same members. `row`: what else the program knows of it. `make`:
/// from the size of a particle's domain at rest, in cells. `support` is the number of nodes per
/// axis.
/// `ends_at_walls`: whether it is cut off at walls at rest (transfer/stencil.hpp), beyond which it
/// would reach.
/// `base_shift()`: the first node of a particle at x is floor(x/h - base_shift). `weights`: r is
/// x/h minus that node; fills w and, times 1/h, the gradients g. (With `carries_domain`, Cpdi's
/// members instead.)
struct Linear {
  /// No step is stable at free edges where the gradient of a velocity is taken that the force has
  /// just changed: where hardly any mass reaches a node, this gradient is as large as ever. Below
  /// the limit of the others the noise of particles that cross cells grows.
  static constexpr ShapeRow row{
      .keyword = "linear",
      .help = "hat functions",
      .words = "linear",
      .stable_cfl = {.increments = 1.42, .velocities = 1.25, .refined = 0.9},
      .cfl_share = 0.42,
      .step_cost = 35};
  static Linear make(double) { return {}; }

  static constexpr bool ends_at_walls = false;
  static constexpr int support = 2;
  static constexpr double base_shift() { return 0.0; }

  [[gnu::always_inline]] static void weights(const Lanes& r, double gradient_scale, Lanes (&w)[2],
                                             Lanes (&g)[2])
  {
    w[0] = 1.0 - r;
    w[1] = r;
    g[0] = -gradient_scale;
    g[1] = gradient_scale;
  }
};

}  // namespace mpm
