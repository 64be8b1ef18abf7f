#pragma once
/// How many locations of a specimen are filled with what, counted in slabs.

#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/share.hpp>

#include <functional>
#include <vector>

namespace mpm::micrograph {

/// Of one window: all locations, and the filled ones by label: the shape's number where there are
/// shapes, else the material's.
struct WindowCount {
  double locations = 0;
  std::vector<double> filled;
};

/// Counts every window (fractions of the specimen) in the slab of each part and sums over the
/// parts. `fill` rasters a lattice whose count and part are set. Collective.
template <int Dim>
std::vector<WindowCount> count_windows(const IndexVec<Dim>& count,
                                       const std::vector<scene::Window>& windows,
                                       std::size_t labels,
                                       const std::function<void(Lattice<Dim>&)>& fill,
                                       const Share& share);

}  // namespace mpm::micrograph
