#pragma once
/// How bright the image is at each location of a lattice laid over it.

#include <mpm/core/index_box.hpp>
#include <mpm/micrograph/image.hpp>

namespace mpm::micrograph {

/// Mean gray level of the image over equal rectangles that cover it, in space of the stack over
/// equal boxes, `count` along each axis, every pixel weighted by the area, every slice by the
/// thickness it shares with them: of those in `part`. x runs fastest, row 0 is at the bottom, layer
/// 0 in the first slice. A single slice goes through all layers.
///
/// Overlaps are whole numbers of (1 / count) pixels and slices, so with gray levels that are whole
/// numbers the sums are exact: a mean equal to a threshold compares equal on every machine.
template <int Dim>
std::vector<double> location_means(const GrayImage& image, const IndexVec<Dim>& count,
                                   const IndexBox<Dim>& part);

extern template std::vector<double> location_means<2>(const GrayImage&, const IndexVec<2>&,
                                                      const IndexBox<2>&);
extern template std::vector<double> location_means<3>(const GrayImage&, const IndexVec<3>&,
                                                      const IndexBox<3>&);

}  // namespace mpm::micrograph
