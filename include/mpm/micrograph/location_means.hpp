#pragma once
/// How bright the image is at each location of a lattice laid over it.

#include <mpm/core/index_box.hpp>
#include <mpm/micrograph/image.hpp>

namespace mpm::micrograph {

/// Mean gray level of the image over equal rectangles that cover it, `count` along each axis, every
/// pixel weighted by the area it shares with the rectangle: of those in `part`. x runs fastest, row
/// 0 at the bottom.
///
/// Overlaps are whole numbers of (1 / count) pixels, so with gray levels that are whole
/// numbers the sums are exact: a mean equal to a threshold compares equal on every machine.
std::vector<double> location_means(const GrayImage& image, const IndexVec<2>& count,
                                   const IndexBox<2>& part);

}  // namespace mpm::micrograph
