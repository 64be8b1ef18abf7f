#pragma once
#include <mpm/core/lanes.hpp>

namespace mpm {

/// In-plane components of a symmetric tensor.
struct InPlane {
  Lanes xx, yy, xy;
};

/// f b f^T with f = I + dt L, of one block. `gradient`: the columns of L, dv_i/dx_j at i + 2 j, 1/s.
[[gnu::always_inline]] inline InPlane pushed_forward(const InPlane& b, const double* gradient,
                                                     double dt)
{
  const double* l = gradient;
  const Lanes fxx = 1.0 + dt * load(l), fyx = dt * load(l + lane_count),
              fxy = dt * load(l + 2 * lane_count), fyy = 1.0 + dt * load(l + 3 * lane_count);
  const Lanes axx = fxx * b.xx + fxy * b.xy, axy = fxx * b.xy + fxy * b.yy,
              ayx = fyx * b.xx + fyy * b.xy, ayy = fyx * b.xy + fyy * b.yy;
  return {axx * fxx + axy * fxy, ayx * fyx + ayy * fyy, axx * fyx + axy * fyy};
}

}  // namespace mpm
