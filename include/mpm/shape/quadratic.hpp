#pragma once
#include <mpm/core/lanes.hpp>
#include <mpm/shape/shape_row.hpp>

namespace mpm {

/// Quadratic B-splines (Steffen, Kirby & Berzins 2008, IJNME 76:922): 3 nodes per axis.
struct Quadratic {
  /// Free corners in the plane and in space bear less than the bar: at 0.9 of its stable step a
  /// beam of Poisson's ratio 0.45 and a block that drifts in space break down (docs/stability.md).
  static constexpr ShapeRow row{.keyword = "quadratic",
                                .help = "quadratic B-splines",
                                .words = "quadratic B-spline",
                                .stable_cfl = {.increments = 2.12,
                                               .velocities = 1.86,
                                               .affine = 0.9,
                                               .refined = 1.34,
                                               .stress_last = 0.69},
                                .cfl_share = 0.7,
                                .step_cost = 50};
  static Quadratic make(double) { return {}; }

  static constexpr bool ends_at_walls = true;
  static constexpr int support = 3;
  static constexpr double base_shift() { return 0.5; }

  [[gnu::always_inline]] static void weights(const Lanes& r, double gradient_scale, Lanes (&w)[3],
                                             Lanes (&g)[3])
  {
    const Lanes a = 1.5 - r, b = r - 1.0, c = r - 0.5;  // r lies in [1/2, 3/2)
    w[0] = 0.5 * a * a;
    w[1] = 0.75 - b * b;
    w[2] = 0.5 * c * c;
    g[0] = -gradient_scale * a;
    g[1] = (-2.0 * gradient_scale) * b;
    g[2] = gradient_scale * c;
  }
};

}  // namespace mpm
