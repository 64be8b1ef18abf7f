#pragma once
/// How bright the image is at each location of a lattice laid over it.

#include <mpm/micrograph/image.hpp>

namespace mpm::micrograph {

/// Mean gray level of the image over each of nx * ny equal rectangles that cover it, every pixel
/// weighted by the area it shares with the rectangle. x runs fastest, row 0 at the bottom.
///
/// Overlaps are whole numbers of (1 / nx, 1 / ny) pixels, so with gray levels that are whole
/// numbers the sums are exact: a mean equal to a threshold compares equal on every machine.
std::vector<double> location_means(const GrayImage& image, int nx, int ny);

}  // namespace mpm::micrograph
