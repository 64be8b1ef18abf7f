/// Particles that go anywhere, and maps of owners that change.

#include <chrono>
#include <thread>

#include "particle_cloud.hpp"
#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace particle_clouds;

TEST(Redistribution, ParticlesDriftingOverCornersArriveOnceWithAllTheirFields)
{
  const IndexVec<2> cells(17, 14);
  Cloud<2> cloud(cells, two_rows(), diagonal_drift<2>(cells));
  add_plastic_body(cloud, 0, 211);
  for (int round = 1; round <= 40; ++round) {
    const auto outcome = cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_arrivals_at_the_end(outcome, round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, ParticlesCrossTwoNodesWidePartsAndSkipRanks)
{
  const IndexVec<2> cells(2 * ranks() - 1, 9);
  Cloud<2> cloud(cells, {ranks(), 1}, random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 97);
  for (int round = 1; round <= 30; ++round) {
    cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, TwoBodiesWithDifferentColumnsKeepApartOverManyFarJumps)
{
  const IndexVec<2> cells(25, 21);
  Cloud<2> cloud(cells, two_rows(), random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 150);
  add_elastic_body(cloud, GlobalIndex{1} << 40, 83);
  for (int round = 1; round <= 60; ++round) {
    const auto outcome = cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_arrivals_at_the_end(outcome, round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, ParticlesInSpaceArriveWithAllTheirFields)
{
  const IndexVec<3> cells(9, 8, 7);
  Cloud<3> cloud(cells, {0, 0, 0}, random_jumps<3>(cells));
  cloud.add_body(5, 130, MotionColumns<3, Tpic>::columns(true),
                 {{"initial_volume", 1, "m3"}, {"stress", 6, "Pa"}, {"plastic_strain", 1, "1"}});
  for (int round = 1; round <= 25; ++round) {
    cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, RanksWithoutAnyParticleAreSkipped)
{
  const IndexVec<2> cells(20, 20);
  Cloud<2> cloud(cells, two_rows(), corner_to_corner(cells));
  add_elastic_body(cloud, 0, 1);
  add_plastic_body(cloud, 1000, 24);
  for (int round = 1; round <= 20; ++round) {
    cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_nothing_lost();
    if (rank() != 0 && rank() != ranks() - 1) {
      EXPECT_EQ(cloud.bodies()[1].particles.size(), 0);
    }
  }
}

TEST(Redistribution, BodyThatLeavesARankAltogetherLeavesNothingBehind)
{
  const IndexVec<2> cells(20, 20);
  Cloud<2> cloud(cells, two_rows(), [&](GlobalIndex id, int round) -> Vec<2> {
    const double place = round % 2 == 0 ? 0.3 : 19.3;
    return Vec<2>(place, place + 0.01 * double(id % 20));
  });
  add_plastic_body(cloud, 0, 33);
  for (int round = 1; round <= 6; ++round) {
    const auto outcome = cloud.move_to(round);
    cloud.expect_home(round);
    GlobalIndex sent = outcome.sent;
    sum_over_ranks(MPI_COMM_WORLD, std::span(&sent, 1));
    EXPECT_EQ(sent, ranks() == 1 ? 0 : 33);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, ParticlesOutsideTheGridStayWithTheNearestRank)
{
  const IndexVec<2> cells(12, 12);
  Cloud<2> cloud(cells, two_rows(), [](GlobalIndex id, int) -> Vec<2> {
    return id == 0 ? Vec<2>(-4, -2) : Vec<2>(15, 13);
  });
  add_plastic_body(cloud, 0, 2);
  cloud.move_to(1);
  cloud.expect_home(1);
  cloud.expect_nothing_lost();
}

TEST(Redistribution, NothingIsLostWhileTheMapOfOwnersChangesAgainAndAgain)
{
  const IndexVec<2> cells(21, 18);
  const GridGeometry<2> grid = Cloud<2>::grid_of(cells);
  Cloud<2> cloud(cells, {0, 0}, random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 150);
  add_elastic_body(cloud, 7000, 90);
  for (int round = 1; round <= 15; ++round) {
    cloud.repartition(round % 3 == 0   ? metis_blocks(grid, ranks())
                      : round % 3 == 1 ? scattered_blocks(grid, 3, ranks(), unsigned(round))
                                       : weighted_cuts<2>(grid, ranks(), two_rows(), {}, {}));
    cloud.expect_home(round - 1);
    cloud.expect_nothing_lost();
    cloud.move_to(round);
    cloud.expect_home(round);
  }
}

// Nothing but the exchange itself keeps the ranks together here: a fast rank's next exchange meets
// a slow one's last.
TEST(Redistribution, ExchangesBackToBackDoNotMixWhenRanksAreDelayed)
{
  const IndexVec<2> cells(22, 19);
  Cloud<2> cloud(cells, two_rows(), random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 120);
  add_elastic_body(cloud, 5000, 70);
  std::mt19937 draw(unsigned(rank() + 1));
  for (int round = 1; round <= 60; ++round) {
    const auto delay = std::chrono::microseconds(draw() % 4 == 0 ? 1500 * (draw() % 3) : 0);
    std::this_thread::sleep_for(delay);
    cloud.move_to(round);
    std::this_thread::sleep_for(std::chrono::microseconds(draw() % 2 == 0 ? 300 * rank() : 0));
    cloud.expect_home(round);
  }
  cloud.expect_nothing_lost();
}

}  // namespace
}  // namespace mpm
