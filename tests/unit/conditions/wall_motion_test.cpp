#include <mpm/conditions/rigid_wall.hpp>

#include <gmock/gmock.h>

namespace mpm {
namespace {

TEST(WallMotion, StartsAtRestAndReachesItsSpeedAtTheEndOfTheRamp)
{
  const WallMotion motion{-10, 2e-6};
  EXPECT_EQ(motion.velocity(0), 0);
  EXPECT_DOUBLE_EQ(motion.velocity(1e-6), -5);
  EXPECT_DOUBLE_EQ(motion.velocity(2e-6), -10);
  EXPECT_EQ(motion.velocity(1), -10);
  EXPECT_EQ(motion.velocity(-1e-6), 0);
  EXPECT_EQ(motion.displacement(-1e-6), 0);
}

TEST(WallMotion, WithoutARampMovesAtOnce)
{
  const WallMotion motion{4, 0};
  EXPECT_EQ(motion.velocity(0), 4);
  EXPECT_DOUBLE_EQ(motion.displacement(3), 12);
  EXPECT_DOUBLE_EQ(motion.time_of(12), 3);
}

/// From t = 0 on, also of a record that begins before.
TEST(WallMotion, DisplacementIsTheIntegralOfATable)
{
  for (const double first : {-1.0, 0.0, 0.25}) {
    const WallMotion motion{0, 0, {{first, 0}, {1, 2}, {1.5, -1}}};
    EXPECT_EQ(motion.displacement(0), 0);
    // The middles of intervals that end where the table bends.
    constexpr int intervals = 80;
    constexpr double step = 2.0 / intervals;
    double integral = 0;
    for (int k = 0; k < intervals; ++k) {
      integral += step * motion.velocity((k + 0.5) * step);
      EXPECT_NEAR(motion.displacement((k + 1) * step), integral, 1e-14) << first << ", " << k;
    }
  }
}

TEST(WallMotion, DisplacementIsTheIntegralOfTheVelocity)
{
  const WallMotion motion{-3, 0.5};
  // Simpson's rule is exact for the cubic of the ramp and the constant behind it, and 0.5 is one
  // of the points: only rounding is left.
  constexpr int intervals = 40;
  constexpr double step = 1.0 / intervals;
  double integral = 0;
  for (int k = 0; k < intervals; ++k) {
    const double t = k * step;
    integral +=
        step / 6 *
        (motion.velocity(t) + 4 * motion.velocity(t + step / 2) + motion.velocity(t + step));
    EXPECT_NEAR(motion.displacement(t + step), integral, 1e-14) << "t = " << t + step;
  }
}

TEST(WallMotion, TimeOfInvertsTheDisplacementInsideAndBehindTheRamp)
{
  for (const double speed : {-7.0, 7.0}) {
    const WallMotion motion{speed, 0.25};
    for (const double time : {0.01, 0.1, 0.2, 0.25, 0.3, 5.0})
      // In the flat start of the ramp a rounding of the displacement is 1 / s^2 larger in time.
      EXPECT_NEAR(motion.time_of(motion.displacement(time)), time, 1e-13)
          << "speed " << speed << ", time " << time;
  }
}

}  // namespace
}  // namespace mpm
