#pragma once
#include <mpm/core/lanes.hpp>
#include <mpm/shape/shape_row.hpp>

namespace mpm {

/// Uniform generalised interpolation (uGIMP; Bardenhagen & Kober 2004, CMES 5:477): hat functions
/// averaged over a particle domain of fixed half size l (in cells), 0 < l <= 1/2. Three nodes per
/// axis, without branches: with t = max(0, r - (1 - l)) the part of the domain beyond node 1,
/// w = {1 - r + q, r - 2q, q}, q = t^2 / (4l).
struct Gimp {
  /// Thin walls that collapse lose the energy balance below the stable step: ponderosa pine closes
  /// to 0.4 % at 0.7 of it and to 2 % at 0.9 of it.
  static constexpr ShapeRow row{.keyword = "gimp",
                                .help = "GIMP (uniform particle domains)",
                                .words = "uniform GIMP",
                                .stable_cfl = {.increments = 1.75,
                                               .velocities = 1.48,
                                               .affine = 0.9,
                                               .refined = 1.02,
                                               .stress_last = 0.59},
                                .cfl_share = 0.7,
                                .step_cost = 50,
                                .has_domain = true};
  static Gimp make(double domain) { return {0.5 * domain}; }

  static constexpr bool ends_at_walls = true;
  static constexpr int support = 3;
  double half_size;  ///< of a particle domain, in cells

  double base_shift() const { return half_size; }

  [[gnu::always_inline]] void weights(const Lanes& r, double gradient_scale, Lanes (&w)[3],
                                      Lanes (&g)[3]) const
  {
    const Lanes t = stdx::max(r - (1.0 - half_size), Lanes(0.0));
    const Lanes e = t * (0.5 / half_size);
    const Lanes q = 0.5 * t * e;
    // 1 - r + q, without its cancellation where the particle's domain leaves this node's cell.
    const Lanes f = 1.0 - e;
    w[0] = half_size * f * f + stdx::max((1.0 - half_size) - r, Lanes(0.0));
    w[1] = r - 2.0 * q;
    w[2] = q;
    g[0] = -f * gradient_scale;
    g[1] = (1.0 - 2.0 * e) * gradient_scale;
    g[2] = e * gradient_scale;
  }
};

}  // namespace mpm
