#include <chrono>
#include <thread>

#include "ragged_blocks.hpp"
#include "sharing.hpp"

namespace mpm {
namespace {

class HaloOfSupport : public testing::TestWithParam<int> {};

TEST_P(HaloOfSupport, SumsEqualTheSerialSumOnEverySharerInAPlane)
{
  Sharing<2> sharing({33, 26}, two_rows<2>(), GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsEqualTheSerialSumOnEverySharerInSpace)
{
  Sharing<3> sharing({14, 13, 9}, two_rows<3>(), GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsHoldWherePartsAreTwoNodesWideAndStencilsReachPastTheNextNeighbour)
{
  Sharing<2> plane({2 * ranks(), 9}, {ranks(), 1}, GetParam());
  plane.expect_serial_sums(0);
  plane.expect_only_shared_nodes_are_exchanged();
  if (ranks() > 2) {
    EXPECT_GE(plane.halo().neighbours().size(), 2u) << "the first rank has one next neighbour";
  }

  Sharing<3> space({5, 2 * ranks(), 6}, {1, ranks(), 1}, GetParam());
  space.expect_serial_sums(0);
  space.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsHoldInPartsTwoNodesWideBothWays)
{
  const IndexVec<2> wish = two_rows<2>();
  Sharing<2> sharing(2 * wish, wish, GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsHoldOnPartsOfAnyShapeInAPlane)
{
  const GridGeometry<2> grid = grid_of<2>({31, 26});
  for (const LocalIndex edge : {1, 3, 5}) {
    Sharing<2> sharing({MPI_COMM_WORLD, scattered_blocks(grid, edge, ranks(), 7)}, GetParam());
    sharing.expect_serial_sums(edge);
    sharing.expect_only_shared_nodes_are_exchanged();
  }
  Sharing<2> sharing({MPI_COMM_WORLD, metis_blocks(grid, ranks())}, GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsHoldOnPartsOfAnyShapeInSpace)
{
  const GridGeometry<3> grid = grid_of<3>({13, 11, 12});
  Sharing<3> scattered({MPI_COMM_WORLD, scattered_blocks(grid, 4, ranks(), 3)}, GetParam());
  scattered.expect_serial_sums(0);
  scattered.expect_only_shared_nodes_are_exchanged();
  Sharing<3> mapped({MPI_COMM_WORLD, metis_blocks(grid, ranks())}, GetParam());
  mapped.expect_serial_sums(0);
  mapped.expect_only_shared_nodes_are_exchanged();
}

/// Weighted cuts of a grid that begins again where it ends.
template <int Dim>
Decomposition<Dim> periodic_cuts(const IndexVec<Dim>& nodes, const IndexVec<Dim>& wish,
                                 std::array<bool, Dim> periodic)
{
  return {MPI_COMM_WORLD, grid_of<Dim>(nodes, periodic), wish, {}, {}};
}

TEST_P(HaloOfSupport, SumsHoldAcrossTheSeamsOfPeriodicAxesInAPlane)
{
  for (const std::array<bool, 2> periodic :
       {std::array{true, false}, {false, true}, {true, true}}) {
    Sharing<2> sharing(periodic_cuts<2>({18, 14}, two_rows<2>(), periodic), GetParam());
    sharing.expect_serial_sums(0);
    sharing.expect_only_shared_nodes_are_exchanged();
    Sharing<2> mapped({MPI_COMM_WORLD, metis_blocks(grid_of<2>({17, 19}, periodic), ranks())},
                      GetParam());
    mapped.expect_serial_sums(1);
    mapped.expect_only_shared_nodes_are_exchanged();
  }
}

TEST_P(HaloOfSupport, SumsHoldAcrossTheSeamsOfPeriodicAxesInSpace)
{
  for (const std::array<bool, 3> periodic : {std::array{true, false, false}, {true, true, true}}) {
    Sharing<3> sharing(periodic_cuts<3>({12, 9, 7}, two_rows<3>(), periodic), GetParam());
    sharing.expect_serial_sums(0);
    sharing.expect_only_shared_nodes_are_exchanged();
  }
}

TEST_P(HaloOfSupport, SumsHoldWhereARankHoldsANodeSeveralTimes)
{
  // Four cells around: a stencil and its halo reach further than once around.
  Sharing<2> sharing(periodic_cuts<2>({4, 2 * ranks()}, {1, ranks()}, {true, true}), GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, EveryNodeHasOneOwnerAndTheOwnerReachesIt)
{
  const GridGeometry<2> grid = grid_of<2>({23, 19});
  const Decomposition<2> decomposition(MPI_COMM_WORLD, scattered_blocks(grid, 3, ranks(), 5));
  const IndexBox<2> local = decomposition.local(decomposition.rank(), GetParam());
  const std::vector<char> owned = owned_nodes(decomposition, GetParam());
  std::vector<double> owners(23 * 19, 0.0);
  for_each_index(local, [&](const IndexVec<2>& node) {
    owners[node[0] + 23 * node[1]] += owned[number_in(local, node)];
  });
  sum_over_ranks(MPI_COMM_WORLD, owners);
  EXPECT_THAT(owners, testing::Each(1.0));
}

TEST_P(HaloOfSupport, NotesTravelWithTheSums)
{
  Sharing<2> sharing({24, 20}, two_rows<2>(), GetParam());
  Halo& halo = sharing.halo();
  const NodeColumn force = sharing.grid().fields.force_column();
  std::vector<LocalIndex> notes;
  for (const int other : halo.neighbours()) notes.push_back(100 * sharing.rank() + other);
  halo.begin(std::span(&force, 1), notes);
  EXPECT_TRUE(halo.untouched());
  halo.advance();
  halo.end();
  for (std::size_t n = 0; n < notes.size(); ++n)
    EXPECT_EQ(halo.notes()[n], 100 * halo.neighbours()[n] + sharing.rank());
  halo.sum(std::span(&force, 1));
  EXPECT_THAT(halo.notes(), testing::Each(0));
  EXPECT_EQ(halo.traffic().messages, 2 * GlobalIndex(notes.size()));
}

TEST_P(HaloOfSupport, SumsOfManyRoundsDoNotMixWhenRanksAreDelayed)
{
  Sharing<2> sharing({21, 18}, two_rows<2>(), GetParam());
  for (int round = 0; round < 12; ++round) {
    const int delay = (round * 7 + sharing.rank() * 5) % 4;
    std::this_thread::sleep_for(std::chrono::microseconds(400 * delay));
    sharing.expect_serial_sums(round);
  }
}

TEST_P(HaloOfSupport, DiagonalRanksShareTheNodesAroundTheCorner)
{
  if (ranks() % 2 != 0) GTEST_SKIP() << "no corner without two rows of ranks";
  Sharing<2> sharing({40, 40}, two_rows<2>(), GetParam());
  const IndexVec<2> corner = sharing.decomposition().owned(0).upper;
  if (ranks() >= 4) {
    EXPECT_EQ(sharing.sharers(corner).size(), 4u);
  }
  if (ranks() == 2) {
    EXPECT_EQ(sharing.sharers({0, corner[1]}).size(), 2u);
  }
  sharing.expect_serial_sums(0);
}

TEST(Halo, OneRankSharesNothing)
{
  const Decomposition<2> alone(MPI_COMM_SELF, {Vec<2>::Zero(), Vec<2>::Ones(), {12, 9}}, {0, 0}, {},
                               {});
  const Halo halo(alone, 3);
  EXPECT_TRUE(halo.shared_nodes().empty());
  EXPECT_TRUE(halo.neighbours().empty());
  EXPECT_EQ(halo.sent_nodes(), 0);
}

INSTANTIATE_TEST_SUITE_P(Supports, HaloOfSupport, testing::Values(2, 3));

}  // namespace
}  // namespace mpm
