#pragma once
/// What lies along an axis of a specimen, and the gaps in it.

#include <mpm/micrograph/specimen.hpp>

#include <span>
#include <vector>

namespace mpm::micrograph {

struct Gaps {
  std::vector<double> layers;  ///< locations of what can be deformed in each layer across the axis
  /// Strain along the axis by which gaps close early: bodies that share nodes feel each other while
  /// about a cell is left between them (docs/accuracy.md), so that every empty run behind something
  /// is short of a cell, or of its width where that is less. Mean over all lines of locations.
  double early_contact = 0;
};

/// Of the whole specimen, in one raster of it. Collective.
template <int Dim>
Gaps gaps_along(const Specimen<Dim>& specimen, std::span<const scene::Material> materials, int axis,
                const Share& share);

}  // namespace mpm::micrograph
