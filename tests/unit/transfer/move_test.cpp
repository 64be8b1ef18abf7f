// What a moving pass notices about the particles it moves.
#include <limits>

#include "expect_equal.hpp"

namespace mpm {
namespace {

using testing::ElementsAre;

constexpr double dt = 0.1;

/// All nodes move with `velocity`; the particles too.
Cloud<2> drifting_cloud(const Vec<2>& velocity)
{
  Cloud<2> cloud({ShapeKind::linear, SchemeKind::flip});
  cloud.set_velocities([&](NaiveNode<2>& n) { n.velocity = velocity; });
  return cloud;
}

TEST(Move, ReportsTheLargestSpeedComponentOfTheGridVelocities)
{
  Cloud<2> cloud = drifting_cloud({0.5, -0.75});
  const auto outcome = cloud.transfer->usl(cloud.body, cloud.grid, dt, cloud.wide_bounds());
  EXPECT_NEAR(outcome.largest_speed, 0.75, rounding);
  EXPECT_TRUE(outcome.blocks_with_leavers.empty());
  EXPECT_FALSE(outcome.lost.has_value());
}

TEST(Move, NamesTheBlocksThatHoldParticlesOutsideTheirHome)
{
  Cloud<2> cloud = drifting_cloud({0, 0});
  const int leaver = lane_count + lane_count / 2;  // in block 1
  cloud.particles[leaver].x = cloud.lower_corner() + Vec<2>(1.2, 0.1);
  cloud.fill_body();
  MoveBounds<2> bounds = cloud.wide_bounds();
  bounds.home_upper[0] = cloud.lower_corner()[0] + 1.0;  // the others end at 0.7 m
  const auto outcome = cloud.transfer->usl(cloud.body, cloud.grid, dt, bounds);
  EXPECT_THAT(outcome.blocks_with_leavers, ElementsAre(1));
  EXPECT_FALSE(outcome.lost.has_value());
}

TEST(Move, AParticleOnTheUpperBoundOfItsHomeLeavesAndOnTheLowerStays)
{
  for (const bool upper : {false, true}) {
    Cloud<2> cloud = drifting_cloud({0, 0});
    for (auto& p : cloud.particles) p.x = cloud.lower_corner() + Vec<2>(0.25, 0.125);
    cloud.fill_body();
    MoveBounds<2> bounds = cloud.wide_bounds();
    (upper ? bounds.home_upper : bounds.home_lower) = cloud.particles[0].x;
    const auto outcome = cloud.transfer->usl(cloud.body, cloud.grid, dt, bounds);
    EXPECT_EQ(int(outcome.blocks_with_leavers.size()), upper ? cloud.body.particles.blocks() : 0);
  }
}

TEST(Move, ReportsTheFirstParticleBeyondReachWithPlaceAndVelocity)
{
  Cloud<2> cloud = drifting_cloud({2, 0});
  MoveBounds<2> bounds = cloud.wide_bounds();
  bounds.home_lower = cloud.lower_corner();
  bounds.home_upper = bounds.home_lower + Vec<2>(0.5, 0.3);
  const int lost = 3;
  for (auto& p : cloud.particles) p.x = cloud.lower_corner();
  cloud.particles[lost].x += Vec<2>(0.4, 0.1);
  cloud.fill_body();
  bounds.reach_upper[0] = cloud.lower_corner()[0] + 0.5;  // it goes to 0.6, the others to 0.2
  const auto outcome = cloud.transfer->usl(cloud.body, cloud.grid, dt, bounds);
  ASSERT_TRUE(outcome.lost.has_value());
  EXPECT_EQ(outcome.lost->id, 1000 + lost);
  EXPECT_NEAR(outcome.lost->position[0], cloud.particles[lost].x[0] + 0.2, rounding);
  EXPECT_LT((outcome.lost->velocity - cloud.particles[lost].v).norm(), rounding);
}

TEST(Move, ReportsAParticleThatIsNoLongerANumber)
{
  Cloud<2> cloud = drifting_cloud({0, 0});
  cloud.set_velocities(
      [&](NaiveNode<2>& n) { n.velocity[1] = std::numeric_limits<double>::quiet_NaN(); });
  MoveBounds<2> bounds = cloud.wide_bounds();
  bounds.home_lower = cloud.lower_corner();
  bounds.home_upper = bounds.home_lower + Vec<2>(0.5, 0.3);
  const auto outcome = cloud.transfer->usl(cloud.body, cloud.grid, dt, bounds);
  ASSERT_TRUE(outcome.lost.has_value());
  EXPECT_EQ(outcome.lost->id, 1000);
}

}  // namespace
}  // namespace mpm
