#pragma once
/// Specimens go on beyond their borders as their own mirror images.

#include <mpm/core/types.hpp>

namespace mpm::micrograph {

/// Of a location beyond [0, count), however far, the one that stands for it between mirrors at both
/// ends.
inline LocalIndex mirrored(LocalIndex at, LocalIndex count)
{
  const LocalIndex period = 2 * count;
  at = (at % period + period) % period;
  return at < count ? at : period - 1 - at;
}

}  // namespace mpm::micrograph
