#pragma once

#include <algorithm>

namespace mpm {

/// `value` (3 s^2 - 2 s^3) with s = time / ramp_time: from 0 at the start to `value` from
/// `ramp_time` on, level at both.
inline double smooth_start(double value, double time, double ramp_time)
{
  if (time >= ramp_time) return value;
  const double s = std::max(0.0, time / ramp_time);
  return value * s * s * (3 - 2 * s);
}

}  // namespace mpm
