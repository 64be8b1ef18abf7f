// Values worked out by hand from the published piecewise definitions.
#include <mpm/shape/cubic.hpp>
#include <mpm/shape/gimp.hpp>
#include <mpm/shape/linear.hpp>
#include <mpm/shape/quadratic.hpp>

#include "sampled_shape.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using testing::DoubleNear;
using testing::Pointwise;

/// A few roundings of numbers of size 1 to 3.
constexpr double rounding = 1e-14;

TEST(LinearShape, IsTheHatOfTheTwoNodesOfTheCell)
{
  const auto s = sample(Linear{}, 2.3);
  EXPECT_EQ(s.base, 2);
  EXPECT_THAT(s.weight, Pointwise(DoubleNear(rounding), {0.7, 0.3}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-1.0, 1.0}));
}

TEST(GimpShape, AveragesTheHatsOverAQuarterCellToEitherSide)
{
  const auto s = sample(Gimp{0.25}, 2.1);
  EXPECT_EQ(s.base, 1);
  EXPECT_THAT(s.weight, Pointwise(DoubleNear(rounding), {0.0225, 0.855, 0.1225}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-0.3, -0.4, 0.7}));
}

TEST(GimpShape, IsTheHatWhereTheDomainLiesInsideOneCell)
{
  const auto s = sample(Gimp{1.0 / 6}, 2.4);
  EXPECT_EQ(s.base, 2);
  EXPECT_THAT(s.weight, Pointwise(DoubleNear(rounding), {0.6, 0.4, 0.0}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-1.0, 1.0, 0.0}));
}

TEST(QuadraticShape, HasTheValuesOfTheQuadraticSpline)
{
  const auto s = sample(Quadratic{}, 2.3);
  EXPECT_EQ(s.base, 1);
  EXPECT_THAT(s.weight, Pointwise(DoubleNear(rounding), {0.02, 0.66, 0.32}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-0.2, -0.6, 0.8}));
}

TEST(GimpShape, IsTheQuadraticSplineWhereTheDomainIsACell)
{
  for (const double x : {2.0, 2.3, 2.5, 2.8}) {
    const auto gimp = sample(Gimp::make(1), x), spline = sample(Quadratic{}, x);
    EXPECT_EQ(gimp.base, spline.base);
    EXPECT_THAT(gimp.weight, Pointwise(DoubleNear(rounding), spline.weight));
    EXPECT_THAT(gimp.gradient, Pointwise(DoubleNear(rounding), spline.gradient));
  }
}

TEST(QuadraticShape, OnANodeIsSymmetric)
{
  const auto s = sample(Quadratic{}, 4.0);
  EXPECT_EQ(s.base, 3);
  EXPECT_THAT(s.weight, Pointwise(DoubleNear(rounding), {0.125, 0.75, 0.125}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-0.5, 0.0, 0.5}));
}

TEST(CubicShape, HasTheValuesOfTheCubicSpline)
{
  const auto s = sample(Cubic{}, 2.5);
  EXPECT_EQ(s.base, 1);
  EXPECT_THAT(s.weight,
              Pointwise(DoubleNear(rounding), {1.0 / 48, 23.0 / 48, 23.0 / 48, 1.0 / 48}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-0.125, -0.625, 0.625, 0.125}));
}

TEST(CubicShape, OnANodeIsSymmetric)
{
  const auto s = sample(Cubic{}, 4.0);
  EXPECT_EQ(s.base, 3);
  EXPECT_THAT(s.weight, Pointwise(DoubleNear(rounding), {1.0 / 6, 2.0 / 3, 1.0 / 6, 0.0}));
  EXPECT_THAT(s.gradient, Pointwise(DoubleNear(rounding), {-0.5, 0.0, 0.5, 0.0}));
}

TEST(GimpShape, WithDomainsOfAWholeCellIsTheQuadraticSpline)
{
  for (double x = 1.003; x < 4; x += 0.0137) {
    const auto gimp = sample(Gimp{0.5}, x), spline = sample(Quadratic{}, x);
    ASSERT_EQ(gimp.base, spline.base);
    ASSERT_THAT(gimp.weight, Pointwise(DoubleNear(rounding), spline.weight)) << "x = " << x;
    ASSERT_THAT(gimp.gradient, Pointwise(DoubleNear(rounding), spline.gradient)) << "x = " << x;
  }
}

TEST(GimpShape, TendsToTheHatAsTheDomainShrinks)
{
  // The average of a hat over +-l differs from the hat by l / 2 at most, at its tip.
  for (const double half_size : {1e-2, 1e-4, 1e-6})
    for (double x = 1; x < 3; x += 0.001) {
      const auto gimp = sample(Gimp{half_size}, x);
      const auto hat = sample(Linear{}, x);
      for (int node = 0; node < 5; ++node)
        ASSERT_NEAR(gimp.weight_of(node), hat.weight_of(node), 0.5 * half_size + rounding)
            << "x = " << x << ", node " << node << ", l = " << half_size;
    }
}

}  // namespace
}  // namespace mpm
