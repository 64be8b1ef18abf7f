#pragma once
/// Which particles a load on a surface acts on.

#include <mpm/conditions/load.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/layout.hpp>

#include <span>
#include <vector>

namespace mpm {

/// Fills the marks' columns at the start, when every particle is at its location's centre. Returns
/// for each mark how many particles of all ranks it has. Collective.
template <int Dim>
std::vector<GlobalIndex> mark_surfaces(MPI_Comm comm, std::span<const SurfaceMark<Dim>> marks,
                                       const IndexVec<Dim>& locations, const Layout<Dim>& layout,
                                       std::vector<Body<Dim>>& bodies);

}  // namespace mpm
