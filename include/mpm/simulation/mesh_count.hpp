#pragma once
/// What the mesh of a total Lagrangian step comes to on any number of ranks, without building it.

#include <mpm/parallel/ownership.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/layout.hpp>

#include <vector>

namespace mpm {

struct MeshCount {
  double nodes = 0;         ///< of this rank's cells; shared ones count on every rank that has them
  double shared_nodes = 0;  ///< with other ranks
  double sent_nodes = 0;    ///< in one exchange, to all of them
  double sharers = 0;       ///< ranks that share nodes with this one
  double contact_cells = 0;  ///< cells so near to a surface that they may meet others
  double hinges = 0;         ///< nodes at which cells hang together by a corner or an edge alone
};

/// Of each rank of `ownership`, which may be others than those of `comm`. Collective.
template <int Dim>
std::vector<MeshCount> count_mesh(const scene::Scene& scene,
                                  const micrograph::Specimen<Dim>& specimen,
                                  const Layout<Dim>& layout, const Ownership<Dim>& ownership,
                                  MPI_Comm comm);

}  // namespace mpm
