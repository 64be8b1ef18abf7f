#pragma once
/// Where on the grid the work is, as coarsely as a partition needs to know.

#include <mpm/parallel/block_partition.hpp>
#include <mpm/parallel/weighted_cuts.hpp>

#include <functional>

#include <mpi.h>

namespace mpm {

/// Work per cell layer along each axis, and per block of cells.
template <int Dim>
class WorkMap {
 public:
  /// Blocks are small enough for a balanced partition on so many ranks.
  WorkMap(const GridGeometry<Dim>& geometry, int ranks);

  void add(const IndexVec<Dim>& cell, double work = 1);
  /// Collective.
  void sum_over_ranks(MPI_Comm comm);

  const LayerWeights<Dim>& layers() const { return layers_; }
  const BlockWork<Dim>& blocks() const { return blocks_; }

 private:
  LayerWeights<Dim> layers_;
  BlockWork<Dim> blocks_;
};

/// visit(cell) for each particle.
template <int Dim>
using CellVisits = std::function<void(const std::function<void(const IndexVec<Dim>&)>& visit)>;

/// Of these particles, how many each rank has under a map of owners.
template <int Dim>
std::vector<double> loads_of(const Ownership<Dim>& ownership, const CellVisits<Dim>& particles);

/// Load of the busiest rank over the mean.
double imbalance_of(const std::vector<double>& loads);

}  // namespace mpm
