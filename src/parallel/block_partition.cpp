#include <mpm/core/error.hpp>
#include <mpm/parallel/block_partition.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
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

std::vector<int> metis_ranks(BlockGraph& graph, const std::vector<double>& weights, int ranks)
{
  // Whole numbers, fine enough for measured costs and small enough to be added up.
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double scale = sum > 0 ? std::min(64.0, 1e9 / sum) : 1.0;
  std::vector<idx_t> work;
  for (const double weight : weights) work.push_back(idx_t(std::lround(scale * weight)));
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

/// Blocks in the order of their distance from work, counted in blocks across faces, and for each
/// the one it was reached from.
struct Surroundings {
  std::vector<LocalIndex> order, from;
  std::size_t near = 0;  ///< so many of them are close to work
};

/// Air farther than this many blocks from work goes to the owner of the nearest: mapped by METIS it
/// would be one rank's at no cost, with a border to all others.
constexpr LocalIndex farthest_mapped = 2;

Surroundings spread_from_work(const BlockGraph& graph, const std::vector<double>& work)
{
  Surroundings found;
  std::vector<LocalIndex> distance(work.size(), -1);
  found.from.assign(work.size(), -1);
  for (std::size_t block = 0; block < work.size(); ++block)
    if (work[block] > 0) found.order.push_back(LocalIndex(block)), distance[block] = 0;
  for (std::size_t k = 0; k < found.order.size(); ++k) {
    const LocalIndex block = found.order[k];
    if (distance[block] <= farthest_mapped) found.near = k + 1;
    for (idx_t n = graph.first[block]; n < graph.first[block + 1]; ++n) {
      const LocalIndex next = LocalIndex(graph.neighbour[n]);
      if (distance[next] >= 0) continue;
      distance[next] = distance[block] + 1;
      found.from[next] = block;
      found.order.push_back(next);
    }
  }
  return found;
}

/// The graph of some blocks alone, numbered in their order.
BlockGraph part_of(const BlockGraph& graph, std::span<const LocalIndex> blocks)
{
  std::vector<LocalIndex> number(graph.first.size() - 1, -1);
  for (std::size_t k = 0; k < blocks.size(); ++k) number[blocks[k]] = LocalIndex(k);
  BlockGraph part;
  for (const LocalIndex block : blocks) {
    for (idx_t n = graph.first[block]; n < graph.first[block + 1]; ++n)
      if (number[graph.neighbour[n]] >= 0) part.neighbour.push_back(number[graph.neighbour[n]]);
    part.first.push_back(idx_t(part.neighbour.size()));
  }
  return part;
}

/// A rank for every block: by METIS near work, by the nearest owner elsewhere.
std::vector<int> map_blocks(BlockGraph& graph, const std::vector<double>& work, int ranks)
{
  const Surroundings all = spread_from_work(graph, work);
  if (all.near < std::size_t(ranks)) return metis_ranks(graph, work, ranks);
  std::vector<LocalIndex> near(all.order.begin(), all.order.begin() + std::ptrdiff_t(all.near));
  std::ranges::sort(near);
  BlockGraph part = part_of(graph, near);
  std::vector<double> part_work;
  for (const LocalIndex block : near) part_work.push_back(work[block]);
  const std::vector<int> mapped = metis_ranks(part, part_work, ranks);
  std::vector<int> rank_of_block(work.size(), 0);
  for (std::size_t k = 0; k < near.size(); ++k) rank_of_block[near[k]] = mapped[k];
  for (std::size_t k = all.near; k < all.order.size(); ++k)
    rank_of_block[all.order[k]] = rank_of_block[all.from[all.order[k]]];
  return rank_of_block;
}

/// A part without a block gets the lightest one of a rank that has several.
void leave_nobody_empty(std::vector<int>& rank_of_block, const std::vector<double>& work, int ranks)
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
  partition.rank = map_blocks(graph, blocks.work, ranks);
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
