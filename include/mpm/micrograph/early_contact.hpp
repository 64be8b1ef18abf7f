#pragma once
/// What contact in one velocity field costs a specimen with gaps.

#include <mpm/micrograph/specimen.hpp>

namespace mpm::micrograph {

/// Strain along an axis by which gaps close early: bodies that share nodes feel each other while
/// about a cell is left between them (docs/accuracy.md), so that every empty run behind something
/// is short of a cell, or of its width where that is less. Mean over all lines of locations.
/// Collective.
template <int Dim>
double early_contact(const Specimen<Dim>& specimen, int axis, const Share& share);

}  // namespace mpm::micrograph
