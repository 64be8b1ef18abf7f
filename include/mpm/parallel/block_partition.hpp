#pragma once
/// Blocks of cells on ranks, where straight cuts cannot balance: a graph partition by METIS.

#include <mpm/core/types.hpp>

#include <vector>

namespace mpm {

/// Blocks of the grid, x fastest, each with the work in it (particles).
template <int Dim>
struct BlockWork {
  IndexVec<Dim> blocks;       ///< per axis
  LocalIndex cells_per_edge;  ///< of a block
  std::vector<double> work;
};

struct BlockPartition {
  std::vector<int> rank;      ///< of each block
  double imbalance = 1;       ///< work of the busiest rank over the mean
  GlobalIndex cut_nodes = 0;  ///< grid nodes on faces between blocks of different ranks
};

/// k-way partition (Karypis & Kumar 1998, SIAM J. Sci. Comput. 20:359) with few cut nodes; every
/// rank gets at least one block, and every rank computes the same result. Throws InputError if
/// there are more ranks than blocks.
template <int Dim>
BlockPartition partition_blocks(const BlockWork<Dim>& blocks, int ranks);

}  // namespace mpm
