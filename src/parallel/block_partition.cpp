#include <mpm/core/error.hpp>
#include <mpm/parallel/block_partition.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include <metis.h>

namespace mpm {

namespace {

/// Neighbours across faces, in the compressed rows that METIS reads.
struct BlockGraph {
  std::vector<idx_t> first{0};
  std::vector<idx_t> neighbour;
};

template <int Dim>
BlockGraph face_neighbours(const IndexVec<Dim>& blocks)
{
  BlockGraph graph;
  for (LocalIndex block = 0; block < blocks.prod(); ++block) {
    LocalIndex stride = 1;
    for (int d = 0; d < Dim; ++d) {
      const LocalIndex at = block / stride % blocks[d];
      if (at > 0) graph.neighbour.push_back(block - stride);
      if (at + 1 < blocks[d]) graph.neighbour.push_back(block + stride);
      stride *= blocks[d];
    }
    graph.first.push_back(idx_t(graph.neighbour.size()));
  }
  return graph;
}

std::vector<int> metis_ranks(BlockGraph& graph, std::vector<idx_t> work, int ranks)
{
  idx_t count = idx_t(work.size()), constraints = 1, parts = ranks, cut = 0;
  std::vector<idx_t> part(work.size(), 0);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_UFACTOR] = 20;  // busiest rank at most 2 % above the mean, if it can be had
  if (METIS_PartGraphKway(&count, &constraints, graph.first.data(), graph.neighbour.data(),
                          work.data(), nullptr, nullptr, &parts, nullptr, nullptr, options, &cut,
                          part.data()) != METIS_OK)
    throw std::runtime_error("METIS could not partition the blocks of the grid");
  return {part.begin(), part.end()};
}

/// A part without a block gets the lightest one of a rank that has several.
void leave_nobody_empty(std::vector<int>& rank_of_block, const std::vector<LocalIndex>& work,
                        int ranks)
{
  std::vector<int> blocks(ranks, 0);
  for (const int rank : rank_of_block) ++blocks[rank];
  if (std::ranges::find(blocks, 0) == blocks.end()) return;
  std::vector<LocalIndex> by_work(work.size());
  std::iota(by_work.begin(), by_work.end(), 0);
  std::ranges::stable_sort(by_work, {}, [&](LocalIndex block) { return work[block]; });
  auto next = by_work.begin();
  for (int rank = 0; rank < ranks; ++rank) {
    if (blocks[rank] > 0) continue;
    while (blocks[rank_of_block[*next]] < 2) ++next;
    --blocks[rank_of_block[*next]];
    rank_of_block[*next++] = rank;
    ++blocks[rank];
  }
}

}  // namespace

template <int Dim>
BlockPartition partition_blocks(const BlockWork<Dim>& blocks, int ranks)
{
  const LocalIndex count = blocks.blocks.prod();
  if (ranks > count)
    throw InputError(std::to_string(ranks) + " ranks for " + std::to_string(count) +
                     " blocks of cells. Use fewer ranks or a finer grid.");
  BlockPartition partition;
  partition.rank.assign(count, 0);
  if (ranks == 1) return partition;
  BlockGraph graph = face_neighbours<Dim>(blocks.blocks);
  partition.rank = metis_ranks(graph, {blocks.work.begin(), blocks.work.end()}, ranks);
  leave_nobody_empty(partition.rank, blocks.work, ranks);

  std::vector<double> load(ranks, 0.0);
  for (LocalIndex block = 0; block < count; ++block)
    load[partition.rank[block]] += blocks.work[block];
  const double mean = std::accumulate(load.begin(), load.end(), 0.0) / ranks;
  if (mean > 0) partition.imbalance = *std::ranges::max_element(load) / mean;

  GlobalIndex nodes_of_face = 1;
  for (int d = 1; d < Dim; ++d) nodes_of_face *= blocks.cells_per_edge;
  for (LocalIndex block = 0; block < count; ++block)
    for (idx_t k = graph.first[block]; k < graph.first[block + 1]; ++k)
      if (graph.neighbour[k] > block && partition.rank[block] != partition.rank[graph.neighbour[k]])
        partition.cut_nodes += nodes_of_face;
  return partition;
}

template BlockPartition partition_blocks(const BlockWork<2>&, int);
template BlockPartition partition_blocks(const BlockWork<3>&, int);

}  // namespace mpm
