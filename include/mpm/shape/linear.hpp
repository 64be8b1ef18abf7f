#pragma once
#include <mpm/core/lanes.hpp>

namespace mpm {

/// Linear (hat) functions: 2 nodes per axis. Gradients jump at cell boundaries ("cell crossing").
///
/// Every shape function has the same three members. `support` is the number of nodes per axis.
/// `base_shift()`: the first node of a particle at x is floor(x/h - base_shift). `weights`: r is
/// x/h minus that node; fills w and, times 1/h, the gradients g.
struct Linear {
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
