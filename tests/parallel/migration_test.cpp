/// Particles that leave a rank in a step.

#include "particle_cloud.hpp"
#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace particle_clouds;

/// Over all ranks. Collective.
GlobalIndex sum_of(GlobalIndex value)
{
  sum_over_ranks(MPI_COMM_WORLD, std::span(&value, 1));
  return value;
}

template <int Dim>
void expect_steps_to_deliver(Cloud<Dim>& cloud, int rounds)
{
  GlobalIndex sent = 0;
  for (int round = 1; round <= rounds; ++round) {
    const auto outcome = cloud.drift_to(round);
    sent += outcome.sent;
    cloud.expect_home(round);
    cloud.expect_arrivals_at_the_end(outcome, round);
    cloud.expect_nothing_lost();
  }
  EXPECT_EQ(sum_of(sent) > 0, ranks() > 1);
}

TEST(MigrationInAStep, ParticlesDriftingOverCornersArriveOnceWithAllTheirFields)
{
  const IndexVec<2> cells(17, 14);
  Cloud<2> cloud(cells, two_rows(), bouncing<2>(cells));
  add_plastic_body(cloud, 0, 211);
  add_elastic_body(cloud, GlobalIndex{1} << 40, 83);
  expect_steps_to_deliver(cloud, 40);
}

TEST(MigrationInAStep, ParticlesCrossTheBordersOfPartsOfAnyShape)
{
  const IndexVec<2> cells(17, 14);
  const GridGeometry<2> grid = Cloud<2>::grid_of(cells);
  for (const LocalIndex edge : {1, 2, 5}) {
    Cloud<2> cloud({MPI_COMM_WORLD, scattered_blocks(grid, edge, ranks(), 11)}, bouncing<2>(cells));
    add_plastic_body(cloud, 0, 130);
    expect_steps_to_deliver(cloud, 20);
  }
  Cloud<2> cloud({MPI_COMM_WORLD, metis_blocks(grid, ranks())}, bouncing<2>(cells));
  add_plastic_body(cloud, 0, 130);
  expect_steps_to_deliver(cloud, 40);
}

TEST(MigrationInAStep, ParticlesCrossTheBordersOfBlocksInSpace)
{
  const IndexVec<3> cells(9, 8, 7);
  Cloud<3> cloud({MPI_COMM_WORLD, metis_blocks(Cloud<3>::grid_of(cells), ranks())},
                 bouncing<3>(cells));
  cloud.add_body(5, 130, MotionColumns<3, Tpic>::columns(true),
                 {{"initial_volume", 1, "m3"}, {"stress", 6, "Pa"}});
  expect_steps_to_deliver(cloud, 25);
}

TEST(MigrationInAStep, NobodySendsAMessageWhileNobodyLeaves)
{
  const IndexVec<2> cells(16, 16);
  Cloud<2> cloud(cells, two_rows(), [](GlobalIndex id, int round) -> Vec<2> {
    return Vec<2>(double(id % 16) + 0.1 * (round % 9 + 1), double(id / 16 % 16) + 0.5);
  });
  add_plastic_body(cloud, 0, 256);
  for (int round = 1; round <= 20; ++round) cloud.drift_to(round);
  EXPECT_EQ(cloud.migration_messages(), 0);
  cloud.expect_home(20);
}

TEST(MigrationInAStep, ParticleBeyondTheNextCellsIsNamed)
{
  if (ranks() == 1) GTEST_SKIP() << "one rank owns every cell";
  const IndexVec<2> cells(6 * ranks(), 6);
  const Decomposition<2> decomposition(MPI_COMM_WORLD, Cloud<2>::grid_of(cells), {ranks(), 1}, {},
                                       {});
  const Halo halo(decomposition, 3);
  Migration<2> migration(decomposition, 3, halo.neighbours());
  Body<2> body{"cloud", 0, 1.0, nullptr,
               ParticleStore(MotionColumns<2, Flip>::columns(false), {}, {"mass"})};
  const IndexBox<2> owned = decomposition.owned(decomposition.rank());
  const bool last = decomposition.rank() == ranks() - 1;
  const double far = last ? owned.lower[0] - 1.5 : owned.upper[0] + 1.5;
  for (const double x : {owned.lower[0] + 1.0, far, owned.lower[0] + 2.0}) {
    const LocalIndex p = body.particles.add(body.particles.size());
    body.particles.motion()(0, p) = x;
    body.particles.motion()(1, p) = 3;
  }
  body.particles.seal();
  const auto strayed = migration.collect(body, 0);
  ASSERT_TRUE(strayed.has_value());
  EXPECT_EQ(*strayed, 1);
}

}  // namespace
}  // namespace mpm
