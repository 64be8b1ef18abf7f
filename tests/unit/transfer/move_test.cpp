// What a moving pass notices about the particles it moves.
#include <limits>

#include "expect_equal.hpp"

namespace mpm {
namespace {

constexpr double dt = 0.1;

/// All nodes move with `velocity`; the particles too.
Cloud<2> drifting_cloud(const Vec<2>& velocity)
{
  Cloud<2> cloud({"linear", "flip"});
  cloud.set_velocities([&](NaiveNode<2>& n) { n.velocity = velocity; });
  return cloud;
}

TEST(Move, ReportsTheLargestSpeedComponentOfTheGridVelocities)
{
  Cloud<2> cloud = drifting_cloud({0.5, -0.75});
  const auto outcome = cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, dt,
                                           cloud.wide_bounds());
  EXPECT_NEAR(outcome.largest_speed, 0.75, rounding);
  EXPECT_FALSE(outcome.lost.has_value());
}

TEST(Move, ReportsTheFirstParticleBeyondReachWithPlaceAndVelocity)
{
  Cloud<2> cloud = drifting_cloud({2, 0});
  const int lost = 3;
  for (auto& p : cloud.particles) p.x = cloud.lower_corner();
  cloud.particles[lost].x += Vec<2>(0.4, 0.1);
  cloud.fill_body();
  // It goes to 0.6 m, the others to 0.2 m.
  const MoveBounds<2> bounds{cloud.lower_corner(), cloud.lower_corner() + Vec<2>(0.5, 0.9)};
  const auto outcome =
      cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, dt, bounds);
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
  const MoveBounds<2> bounds{cloud.lower_corner(), cloud.lower_corner() + Vec<2>(1.5, 0.9)};
  const auto outcome =
      cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, dt, bounds);
  ASSERT_TRUE(outcome.lost.has_value());
  EXPECT_EQ(outcome.lost->id, 1000);
}

}  // namespace
}  // namespace mpm
