#pragma once
#include <mpm/core/lanes.hpp>
#include <mpm/shape/shape_row.hpp>

namespace mpm {

/// Cubic B-splines (Steffen, Kirby & Berzins 2008, IJNME 76:922): 4 nodes per axis.
struct Cubic {
  static constexpr ShapeRow row{.keyword = "cubic",
                                .help = "cubic B-splines",
                                .words = "cubic B-spline",
                                .stable_cfl = {.increments = 2.58,
                                               .velocities = 2.27,
                                               .affine = 0.9,
                                               .refined = 1.67,
                                               .stress_last = 1.08},
                                .cfl_share = 0.7,
                                .step_cost = 75};
  static Cubic make(double) { return {}; }

  static constexpr bool ends_at_walls = true;
  static constexpr int support = 4;
  static constexpr double base_shift() { return 1.0; }

  [[gnu::always_inline]] static void weights(const Lanes& r, double gradient_scale, Lanes (&w)[4],
                                             Lanes (&g)[4])
  {
    constexpr double sixth = 1.0 / 6.0;
    const Lanes a = 2.0 - r, b = r - 1.0;  // r lies in [1, 2)
    const Lanes aa = a * a, bb = b * b;
    w[0] = sixth * aa * a;
    w[1] = (2.0 / 3.0) - bb + 0.5 * bb * b;
    w[2] = (2.0 / 3.0) - aa + 0.5 * aa * a;
    w[3] = sixth * bb * b;
    g[0] = (-0.5 * gradient_scale) * aa;
    g[1] = gradient_scale * (1.5 * bb - 2.0 * b);
    g[2] = gradient_scale * (2.0 * a - 1.5 * aa);
    g[3] = (0.5 * gradient_scale) * bb;
  }
};

}  // namespace mpm
