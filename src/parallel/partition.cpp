#include <mpm/parallel/partition.hpp>

#include <algorithm>
#include <map>

namespace mpm {

namespace {

/// By how much cuts may be less balanced than blocks before blocks are taken: these have the longer
/// and more ragged borders.
constexpr double worth_of_cuts = 0.05;

/// Numbers the parts anew: greedily, the largest amounts of work that have the same rank before and
/// after come first.
template <int Dim>
void keep_owners(std::vector<int>& rank_of_block, int ranks, const BlockWork<Dim>& blocks,
                 const Ownership<Dim>& before)
{
  std::map<std::pair<int, int>, double> common;  // part, owner before -> work
  for (std::size_t block = 0; block < rank_of_block.size(); ++block) {
    IndexVec<Dim> cell;
    LocalIndex rest = LocalIndex(block);
    for (int d = 0; d < Dim; ++d) {
      cell[d] = rest % blocks.blocks[d] * blocks.cells_per_edge + blocks.cells_per_edge / 2;
      rest /= blocks.blocks[d];
    }
    common[{rank_of_block[block], before.owner_of_cell(cell)}] += blocks.work[block];
  }
  std::vector<std::pair<double, std::pair<int, int>>> by_work;
  for (const auto& [pair, work] : common) by_work.push_back({-work, pair});
  std::ranges::sort(by_work);
  std::vector<int> rank_of_part(ranks, -1);
  std::vector<char> taken(ranks, 0);
  for (const auto& [work, pair] : by_work) {
    const auto [part, rank] = pair;
    if (rank_of_part[part] >= 0 || taken[rank]) continue;
    rank_of_part[part] = rank;
    taken[rank] = 1;
  }
  int next = 0;
  for (int& rank : rank_of_part) {
    if (rank >= 0) continue;
    while (taken[next]) ++next;
    rank = next++;
  }
  for (int& rank : rank_of_block) rank = rank_of_part[rank];
}

}  // namespace

template <int Dim>
Ownership<Dim> block_ownership(const GridGeometry<Dim>& geometry, int ranks,
                               const WorkMap<Dim>& work, const Ownership<Dim>* before)
{
  std::vector<int> rank_of_block = partition_blocks(work.blocks(), ranks).rank;
  if (before) keep_owners(rank_of_block, ranks, work.blocks(), *before);
  return {geometry, work.blocks().cells_per_edge, std::move(rank_of_block), ranks};
}

template <int Dim>
Partition<Dim> choose_partition(const GridGeometry<Dim>& geometry, int ranks,
                                const PartitionRules<Dim>& rules, const WorkMap<Dim>& work,
                                const LoadsUnder<Dim>& loads_under, const Ownership<Dim>* before)
{
  const auto with_loads = [&](Ownership<Dim> ownership) -> Partition<Dim> {
    std::vector<double> loads = loads_under(ownership);
    return {std::move(ownership), std::move(loads)};
  };
  const auto cuts = [&] {
    return with_loads(
        weighted_cuts<Dim>(geometry, ranks, rules.ranks, work.layers(), rules.keep_whole));
  };
  const auto blocks = [&] { return with_loads(block_ownership(geometry, ranks, work, before)); };
  if (rules.kind == PartitionKind::metis) return blocks();
  const bool grid_given = (rules.ranks.array() > 0).any();
  if (rules.kind == PartitionKind::automatic && !grid_given &&
      !can_be_cut<Dim>(geometry, ranks, rules.ranks))
    return blocks();
  Partition<Dim> straight = cuts();
  if (rules.kind == PartitionKind::cuts || grid_given || straight.imbalance() <= 1 + worth_of_cuts)
    return straight;
  Partition<Dim> ragged = blocks();
  return ragged.imbalance() + worth_of_cuts < straight.imbalance() ? ragged : straight;
}

template Ownership<2> block_ownership(const GridGeometry<2>&, int, const WorkMap<2>&,
                                      const Ownership<2>*);
template Ownership<3> block_ownership(const GridGeometry<3>&, int, const WorkMap<3>&,
                                      const Ownership<3>*);
template Partition<2> choose_partition(const GridGeometry<2>&, int, const PartitionRules<2>&,
                                       const WorkMap<2>&, const LoadsUnder<2>&,
                                       const Ownership<2>*);
template Partition<3> choose_partition(const GridGeometry<3>&, int, const PartitionRules<3>&,
                                       const WorkMap<3>&, const LoadsUnder<3>&,
                                       const Ownership<3>*);

}  // namespace mpm
