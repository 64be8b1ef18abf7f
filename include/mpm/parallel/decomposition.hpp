#pragma once
/// Which rank owns which cells and nodes of the background grid.

#include <mpm/grid/node_grid.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <mpi.h>

namespace mpm {

/// Ownership from a PETSc DMDA: a tensor product of cuts, ranks x fastest. Node i and cell i
/// (between nodes i and i + 1) belong to the same rank; the last node of an axis bounds no cell.
template <int Dim>
class Decomposition {
 public:
  /// Per axis, the work in each cell layer: cuts are placed so that each rank's layers weigh about
  /// the same (an empty span: equal counts). `ranks`: 0 in an axis lets the choice to us: cuts
  /// across `keep_whole` come last, because a piston along that axis empties part of it.
  /// Collective. Throws InputError if there are more ranks than the grid can feed.
  Decomposition(MPI_Comm comm, const GridGeometry<Dim>& geometry, IndexVec<Dim> ranks,
                const std::array<std::vector<double>, Dim>& layer_weights,
                std::optional<int> keep_whole);

  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  int ranks() const { return ranks_of_axis_.prod(); }
  const IndexVec<Dim>& ranks_per_axis() const { return ranks_of_axis_; }
  const GridGeometry<Dim>& geometry() const { return geometry_; }

  /// Nodes that a rank owns.
  IndexBox<Dim> owned(int rank) const;
  /// Owned nodes and all that the stencils of its particles reach, also after a step in which they
  /// have moved by up to one cell beyond the owned ones.
  IndexBox<Dim> local(int rank, int support) const;
  /// Owner of a cell inside the grid.
  int owner_of_cell(const IndexVec<Dim>& cell) const;

 private:
  MPI_Comm comm_;
  int rank_;
  GridGeometry<Dim> geometry_;
  IndexVec<Dim> ranks_of_axis_;
  std::array<std::vector<LocalIndex>, Dim> cuts_;  ///< first node of each part, and the end
};

}  // namespace mpm
