#pragma once
/// The grid shared out among the ranks of a communicator.

#include <mpm/parallel/ownership.hpp>
#include <mpm/parallel/petsc_handles.hpp>
#include <mpm/parallel/weighted_cuts.hpp>

#include <memory>

#include <mpi.h>

namespace mpm {

/// Copies share the DMDA.
template <int Dim>
class Decomposition {
 public:
  /// One rank of the communicator for each of the map. Cuts become a PETSc DMDA, whose ownership
  /// this is. Collective.
  Decomposition(MPI_Comm comm, const Ownership<Dim>& ownership);
  /// Weighted cuts for all ranks of the communicator. Collective. Throws InputError if there are
  /// more ranks than the grid can feed.
  Decomposition(MPI_Comm comm, const GridGeometry<Dim>& geometry, const IndexVec<Dim>& ranks,
                const LayerWeights<Dim>& layer_weights, std::optional<int> keep_whole);

  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  const Ownership<Dim>& ownership() const { return ownership_; }

  int ranks() const { return ownership_.ranks(); }
  const GridGeometry<Dim>& geometry() const { return ownership_.geometry(); }
  IndexVec<Dim> ranks_per_axis() const { return ownership_.ranks_per_axis(); }
  IndexBox<Dim> owned(int rank) const { return ownership_.owned(rank); }
  IndexBox<Dim> local(int rank, int support) const { return ownership_.local(rank, support); }
  int owner_of_cell(const IndexVec<Dim>& cell) const { return ownership_.owner_of_cell(cell); }

  /// The DMDA of cuts, with one unknown per node and no ghosts; null for blocks.
  _p_DM* dmda() const { return dmda_.get(); }
  /// Numbers in the whole run of the nodes that this rank owns, in the order of their local
  /// numbers: of cuts the DMDA's, of blocks its own. Both give each rank a range, in the order of
  /// the ranks. Collective.
  std::vector<GlobalIndex> numbers_of_owned() const;

 private:
  MPI_Comm comm_;
  int rank_;
  GridHandle dmda_;
  Ownership<Dim> ownership_;
};

/// Which nodes of this rank's local box it owns, local numbering; images are owned by nobody.
template <int Dim>
std::vector<char> owned_nodes(const Decomposition<Dim>& decomposition, int support);

}  // namespace mpm
