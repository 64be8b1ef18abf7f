#pragma once
/// Maps of owners that no cuts could make.

#include <mpm/parallel/partition.hpp>

#include <random>

namespace mpm {

/// Every block goes to some rank, near or far: parts in many pieces, with corners everywhere.
template <int Dim>
Ownership<Dim> scattered_blocks(const GridGeometry<Dim>& geometry, LocalIndex edge, int ranks,
                                unsigned seed)
{
  const IndexVec<Dim> blocks = (geometry.nodes.array() + edge - 1) / edge;
  std::vector<int> rank_of_block(blocks.prod());
  for (std::size_t block = 0; block < rank_of_block.size(); ++block)
    rank_of_block[block] = int(block) % ranks;  // nobody is left out
  std::shuffle(rank_of_block.begin(), rank_of_block.end(), std::mt19937(seed));
  return {geometry, edge, std::move(rank_of_block), ranks};
}

/// What METIS makes of work that lies along a diagonal.
template <int Dim>
Ownership<Dim> metis_blocks(const GridGeometry<Dim>& geometry, int ranks)
{
  WorkMap<Dim> work(geometry, ranks);
  for_each_index(IndexBox<Dim>{IndexVec<Dim>::Zero(), geometry.nodes},
                 [&](const IndexVec<Dim>& cell) {
                   if (std::abs(cell[0] - cell[1]) < 6) work.add(cell);
                 });
  return block_ownership<Dim>(geometry, ranks, work, nullptr);
}

}  // namespace mpm
