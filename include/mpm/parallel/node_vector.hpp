#pragma once
/// Values of the active nodes as PETSc's vectors and matrices have them.

#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/petsc_handles.hpp>

#include <span>
#include <vector>

namespace mpm {

/// Every active node of the run has a row; rows are numbered from 0 in the order of the nodes'
/// numbers, so that each rank has a range of them. The image of a node has the node's row. Holds
/// until nodes become active or inactive, or the borders move.
///
/// With `width` unknowns per node, unknown c of row r is entry r * width + c.
template <int Dim>
class NodeRows {
 public:
  /// `active`: one mark per local node, of which those of the nodes count that this rank owns.
  /// Topology and halo are this decomposition's and outlive this. Collective.
  NodeRows(const Decomposition<Dim>& decomposition, const GridTopology<Dim>& topology, Halo& halo,
           std::span<const char> active);

  GlobalIndex count() const { return count_; }  ///< of all ranks
  GlobalIndex first() const { return first_; }  ///< of this rank
  /// Active nodes that this rank owns, local numbering: row first() + k is that of owned()[k].
  std::span<const LocalIndex> owned() const { return owned_; }
  /// Row of a node that this rank owns or that its particles may reach; -1 where it is inactive,
  /// and of every other node.
  GlobalIndex of(LocalIndex node) const { return rows_[node]; }

  /// A vector of zeros. Collective. Throws InputError if PETSc cannot count its entries.
  VectorHandle vector(int width) const;
  /// A matrix of zeros with room for what couples nodes that are up to `reach` (less than the
  /// support) apart on every axis. Collective. Throws InputError as `vector` does.
  MatrixHandle matrix(int width, LocalIndex reach) const;

  /// From the nodes that this rank owns.
  void to_vector(const NodeColumn& column, _p_Vec* vector) const;
  /// To all nodes that have a row here; all others get 0. Collective.
  void from_vector(_p_Vec* vector, const NodeColumn& column) const;

 private:
  struct Couplings;
  Couplings couplings(LocalIndex reach) const;
  void expect_countable(int width) const;

  MPI_Comm comm_;
  const GridTopology<Dim>& topology_;
  Halo& halo_;
  GlobalIndex count_ = 0, first_ = 0;
  std::vector<LocalIndex> owned_;
  std::vector<GlobalIndex> rows_;  ///< of each local node
};

}  // namespace mpm
