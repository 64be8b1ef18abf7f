#pragma once
/// What bodies of rigid materials are in either formulation.

#include <mpm/simulation/model.hpp>

namespace mpm {

/// The part of a box of locations outside of which this rank has no cells.
template <int Dim>
IndexBox<Dim> nearby(const IndexBox<Dim>& locations, const Layout<Dim>& layout,
                     const Decomposition<Dim>& decomposition)
{
  IndexBox<Dim> near = decomposition.owned(decomposition.rank());
  near.lower = (near.lower - layout.padding) * layout.per_cell;
  near.upper = (near.upper - layout.padding) * layout.per_cell;
  return intersection(locations, near);
}

/// `material`: a number in the scene. Collective.
template <int Dim>
void add_rigid_body(const scene::Scene& scene, int material,
                    const micrograph::Specimen<Dim>& specimen, const Layout<Dim>& layout,
                    const Decomposition<Dim>& decomposition, Model<Dim>& model);

}  // namespace mpm
