/// Which map of owners is chosen, what is said of it beforehand, and borders that follow the work.

#include <mpm/core/error.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/partition_report.hpp>
#include <mpm/stepping/load_balance.hpp>

#include <algorithm>
#include <numeric>

#include "flying_block.hpp"
#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using testing::HasSubstr;

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}

GridGeometry<2> plane_grid()
{
  return {Vec<2>::Zero(), Vec<2>::Ones(), {61, 49}};
}

/// Particles in all cells of a box.
CellVisits<2> filled(const IndexBox<2>& box)
{
  return
      [box](const std::function<void(const IndexVec<2>&)>& visit) { for_each_index(box, visit); };
}

/// In a band along the diagonal, which no process grid can share out evenly.
void diagonal(const std::function<void(const IndexVec<2>&)>& visit)
{
  for_each_index(IndexBox<2>{{0, 0}, {48, 48}}, [&](const IndexVec<2>& cell) {
    if (std::abs(cell[0] - cell[1]) < 5) visit(cell);
  });
}

Partition<2> choose(const PartitionRules<2>& rules, int count, const CellVisits<2>& particles)
{
  WorkMap<2> work(plane_grid(), count);
  particles([&](const IndexVec<2>& cell) { work.add(cell); });
  return choose_partition<2>(
      plane_grid(), count, rules, work,
      [&](const Ownership<2>& ownership) { return loads_of(ownership, particles); }, nullptr);
}

TEST(PartitionChoice, EvenWorkIsCutStraight)
{
  const Partition<2> found = choose({}, 4, filled({{0, 0}, {60, 48}}));
  EXPECT_TRUE(found.ownership.by_cuts());
  EXPECT_LT(found.imbalance(), 1.05);
}

TEST(PartitionChoice, WorkThatCutsCannotBalanceGoesToBlocks)
{
  const Partition<2> found = choose({}, 4, diagonal);
  EXPECT_FALSE(found.ownership.by_cuts());
  const PartitionRules<2> cuts_only{PartitionKind::cuts, {2, 2}, {}};
  const Partition<2> straight = choose(cuts_only, 4, diagonal);
  EXPECT_TRUE(straight.ownership.by_cuts());
  // Two of the four quarters hold next to nothing.
  EXPECT_GT(straight.imbalance(), 1.5);
  EXPECT_LT(found.imbalance(), 1.05);
}

TEST(PartitionChoice, ANumberOfRanksThatNoGridOfThemHasGoesToBlocks)
{
  constexpr int prime = 37;  // parts of at least two nodes along one axis: there are not enough
  const Partition<2> found = choose({}, prime, filled({{0, 0}, {60, 48}}));
  EXPECT_FALSE(found.ownership.by_cuts());
  EXPECT_GT(std::ranges::min(found.loads), 0);
  EXPECT_THROW(choose({PartitionKind::cuts, {0, 0}, {}}, prime, filled({{0, 0}, {60, 48}})),
               InputError);
}

TEST(PartitionChoice, AGivenProcessGridIsKept)
{
  const Partition<2> found = choose({PartitionKind::automatic, {2, 2}, {}}, 4, diagonal);
  EXPECT_EQ(found.ownership.ranks_per_axis(), IndexVec<2>(2, 2));
}

TEST(PartitionChoice, LoadsAreThoseOfTheParticles)
{
  for (const PartitionKind kind : {PartitionKind::cuts, PartitionKind::metis}) {
    const Partition<2> found = choose({kind, {0, 0}, {}}, 3, filled({{5, 5}, {25, 40}}));
    EXPECT_EQ(std::accumulate(found.loads.begin(), found.loads.end(), 0.0), 20 * 35);
    EXPECT_DOUBLE_EQ(found.imbalance(), *std::ranges::max_element(found.loads) * 3 / (20 * 35));
  }
}

TEST(PartitionChoice, EveryRankHasABlockEvenWhereNearlyAllAreEmpty)
{
  const Partition<2> found =
      choose({PartitionKind::metis, {0, 0}, {}}, 40, filled({{2, 2}, {4, 4}}));
  for (int rank = 0; rank < 40; ++rank) EXPECT_FALSE(found.ownership.owned(rank).empty());
}

TEST(PartitionOfBlocks, PartsKeepTheRanksThatHaveMostOfTheirWork)
{
  constexpr int count = 5;
  WorkMap<2> work(plane_grid(), count);
  filled({{0, 0}, {60, 48}})([&](const IndexVec<2>& cell) { work.add(cell); });
  const Ownership<2> first = block_ownership<2>(plane_grid(), count, work, nullptr);
  // The same parts under other numbers: asked again, each rank gets its own back.
  std::vector<int> renumbered;
  const LocalIndex edge = first.block_edge();
  for_each_index(IndexBox<2>{{0, 0}, work.blocks().blocks}, [&](const IndexVec<2>& block) {
    renumbered.push_back((first.owner_of_cell(edge * block) + 2) % count);
  });
  const Ownership<2> before(plane_grid(), edge, renumbered, count);
  const Ownership<2> after = block_ownership<2>(plane_grid(), count, work, &before);
  for_each_index(IndexBox<2>{{0, 0}, {60, 48}}, [&](const IndexVec<2>& cell) {
    EXPECT_EQ(after.owner_of_cell(cell), before.owner_of_cell(cell));
  });
}

template <int Dim>
void expect_report_of_the_halo(const Ownership<Dim>& ownership, int support)
{
  const Halo halo(Decomposition<Dim>(MPI_COMM_WORLD, ownership), support);
  std::array<double, 3> largest{double(halo.shared_nodes().size()),
                                double(halo.neighbours().size()),
                                8.0 * (1 + 2 * Dim) * double(halo.sent_nodes())};
  largest_over_ranks(MPI_COMM_WORLD, largest);
  const PartitionReport report =
      report_on<Dim>(ownership, support, [](const std::function<void(const IndexVec<Dim>&)>&) {});
  EXPECT_EQ(report.shared_nodes, largest[0]);
  EXPECT_EQ(report.messages, largest[1]);
  EXPECT_EQ(report.bytes, largest[2]);
}

TEST(PartitionReport, SaysWhatTheHaloOfARealRunHas)
{
  const GridGeometry<3> space{Vec<3>::Zero(), Vec<3>::Ones(), {13, 12, 14}};
  for (const int support : {2, 3}) {
    expect_report_of_the_halo(weighted_cuts<2>(plane_grid(), ranks(), {0, 0}, {}, {}), support);
    expect_report_of_the_halo(metis_blocks(plane_grid(), ranks()), support);
    expect_report_of_the_halo(scattered_blocks(plane_grid(), 7, ranks(), 1), support);
    expect_report_of_the_halo(metis_blocks(space, ranks()), support);
  }
}

TEST(PartitionReport, TableHasALinePerMapAndState)
{
  const std::string table = partition_table<2>(
      plane_grid(), {1, 6, 100000}, {}, grid_reporter<2>(3), diagonal, filled({{0, 0}, {48, 20}}));
  // Header; two maps in three states for 1 and 6 ranks; two refusals of too many ranks.
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 2 * 2 * 3 + 2);
  EXPECT_THAT(table, HasSubstr("100000  cuts   numerics.ranks: 100000 ranks cannot be arranged"));
}

/// A block in one corner of a grid that is cut evenly, so that most ranks have nothing to do.
TEST(LoadBalance, BordersFollowTheWorkAndStayWhereNothingIsGained)
{
  using namespace testing_blocks;
  const GridGeometry<2> grid = BlockRun::grid_of({70, 70});
  BlockRun run({MPI_COMM_WORLD, grid, {0, 0}, {}, {}}, {"gimp", "flip", "musl"},
               {{{4, 4}, {30, 30}, {1, 1}}}, {});
  run.stepper().step(1e-9);
  run.stepper().check();
  if (ranks() > 1) {
    EXPECT_GE(run.stepper().agreed().imbalance(), 2.0);
  }
  LoadBalance<2> balance({}, 0);
  for (int step = 0; step < 400; ++step) {
    run.stepper().step(0.4 * cell / run.stepper().bodies().front().law->wave_speed());
    balance.look(run.stepper());
  }
  if (ranks() == 1) {
    EXPECT_EQ(balance.repartitions(), 0);
    return;
  }
  EXPECT_GE(balance.repartitions(), 1);
  EXPECT_LE(balance.repartitions(), 5);  // 400 steps have 20 checks
  std::vector<double> loads(ranks(), 0.0);
  loads[rank_of(MPI_COMM_WORLD)] = run.stepper().particles();
  sum_over_ranks(MPI_COMM_WORLD, loads);
  EXPECT_EQ(std::accumulate(loads.begin(), loads.end(), 0.0), 4 * 30 * 30);
  // An even cut begins with 2 or more. What a particle costs is measured, so that the numbers of
  // particles need not become equal: by no more than the slowest check could claim.
  EXPECT_LT(imbalance_of(loads), 1.3);
}

}  // namespace
}  // namespace mpm
