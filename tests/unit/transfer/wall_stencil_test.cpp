// Stencils of particles beside walls at rest.
#include <mpm/shape/shape_types.hpp>
#include <mpm/transfer/domain_stencil.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace mpm {
namespace {

constexpr double h = 0.37, rounding = 1e-12;
constexpr int cells = 12, lower_wall = 3, upper_wall = 9;

GridTopology<2> grid_between(std::optional<LocalIndex> lower, std::optional<LocalIndex> upper)
{
  GridGeometry<2> geometry{Vec<2>(-0.2, 0.5), Vec<2>(h, h), IndexVec<2>(cells + 1, cells + 1)};
  geometry.walls[0] = {lower, upper};
  const IndexBox<2> all{IndexVec<2>::Zero(), geometry.nodes};
  return {geometry, all, all};
}

/// Along x, of a particle at `x` cells from node 0; a value for each node of the grid.
struct Weights {
  double weight[cells + 1] = {}, gradient[cells + 1] = {};  ///< 1, 1/m
};

/// Of a particle as it was made, two of them per cell and direction.
template <class Shape>
Stencil<2, Shape> stencil_at(const Lanes (&position)[2], const GridFrame<2>& frame)
{
  if constexpr (CarriesDomain<Shape>) {
    const Lanes domain[4] = {0.25 * h, 0.0, 0.0, 0.25 * h};
    return {position, domain, frame, Shape::make(0.5)};
  } else {
    return {position, frame, Shape::make(0.5)};
  }
}

template <class Shape>
Weights weights_at(double x, const GridTopology<2>& grid)
{
  const Lanes position[2] = {Lanes(-0.2 + x * h), Lanes(0.5 + 6.3 * h)};
  const GridFrame<2> frame(grid);
  const Stencil<2, Shape> stencil = stencil_at<Shape>(position, frame);
  Weights result;
  const int first = int(stencil.base[0]) % (cells + 1);
  for (int a = 0; a < Shape::support; ++a) {
    if constexpr (CarriesDomain<Shape>) {
      for (int k = a; k < stencil.nodes; k += Shape::support) {
        result.weight[first + a] += stencil.weight[k][0];
        result.gradient[first + a] += stencil.gradient[0][k][0];
      }
    } else {
      result.weight[first + a] = stencil.weight[0][a][0];
      result.gradient[first + a] = stencil.gradient[0][a][0];
    }
  }
  return result;
}

template <class Shape>
class WallStencil : public testing::Test {
 protected:
  const GridTopology<2> walled = grid_between(lower_wall, upper_wall), open = grid_between({}, {});
};
template <class... Shape>
testing::Types<Shape...> types_of(TypeList<Shape...>);
using Shapes = decltype(types_of(ShapeTypes{}));
TYPED_TEST_SUITE(WallStencil, Shapes);

TYPED_TEST(WallStencil, BetweenTheWallsLinearFieldsAreReproduced)
{
  for (double x = lower_wall; x < upper_wall; x += 0.0371) {
    const Weights s = weights_at<TypeParam>(x, this->walled);
    double sum = 0, value = 0, slope = 0;
    for (int k = 0; k <= cells; ++k) {
      sum += s.weight[k];
      value += s.weight[k] * k;
      slope += s.gradient[k] * k * h;
      ASSERT_GE(s.weight[k], -rounding) << "x = " << x << ", node " << k;
    }
    ASSERT_NEAR(sum, 1, rounding) << "x = " << x;
    ASSERT_NEAR(value, x, rounding) << "x = " << x;
    ASSERT_NEAR(slope, 1, rounding) << "x = " << x;
  }
}

TYPED_TEST(WallStencil, GradientsAreDifferenceQuotientsOfTheWeights)
{
  if (!TypeParam::ends_at_walls) GTEST_SKIP() << "it does not change at walls";
  constexpr double step = 1e-6;
  for (double x = lower_wall + 0.01; x < upper_wall - 0.01; x += 0.0373) {
    const Weights s = weights_at<TypeParam>(x, this->walled),
                  before = weights_at<TypeParam>(x - step, this->walled),
                  after = weights_at<TypeParam>(x + step, this->walled);
    for (int k = 0; k <= cells; ++k)
      ASSERT_NEAR(h * s.gradient[k], (after.weight[k] - before.weight[k]) / (2 * step), 1e-6)
          << "x = " << x << ", node " << k;
  }
}

TYPED_TEST(WallStencil, NothingIsGivenToNodesBehindAWall)
{
  if (!TypeParam::ends_at_walls) GTEST_SKIP() << "it reaches beyond walls";
  for (const double beside : {-0.9, -0.3, -1e-9, 0.0, 1e-9, 0.2, 0.49, 0.51, 0.99})
    for (const bool upper : {false, true}) {
      const double x = upper ? upper_wall - beside : lower_wall + beside;
      const Weights s = weights_at<TypeParam>(x, this->walled);
      for (int k = 0; k <= cells; ++k) {
        const bool behind = upper ? k > upper_wall : k < lower_wall;
        ASSERT_GE(s.weight[k], -rounding) << "x = " << x << ", node " << k;
        if (behind) {
          ASSERT_EQ(s.weight[k], 0) << "x = " << x << ", node " << k;
          ASSERT_EQ(s.gradient[k], 0) << "x = " << x << ", node " << k;
        }
      }
      if (beside > 0) continue;
      ASSERT_NEAR(s.weight[upper ? upper_wall : lower_wall], 1, 1e-8) << "x = " << x;
    }
}

TYPED_TEST(WallStencil, FarFromWallsNothingChanges)
{
  for (double x = lower_wall + 1; x < upper_wall - 1; x += 0.0373) {
    const Weights s = weights_at<TypeParam>(x, this->walled),
                  free = weights_at<TypeParam>(x, this->open);
    for (int k = 0; k <= cells; ++k) {
      ASSERT_EQ(s.weight[k], free.weight[k]);
      ASSERT_EQ(s.gradient[k], free.gradient[k]);
    }
  }
}

TYPED_TEST(WallStencil, AffineWeightsAreNumbersOnTheWallItself)
{
  const Lanes position[2] = {Lanes(-0.2 + lower_wall * h), Lanes(0.5 + 6.3 * h)};
  const GridFrame<2> frame(this->walled);
  Stencil<2, TypeParam> stencil = stencil_at<TypeParam>(position, frame);
  stencil.measure_offsets(frame);
  alignas(lane_alignment) typename Stencil<2, TypeParam>::Columns affine;
  stencil.affine_weights(affine);
  for (int a = 0; a < TypeParam::support; ++a) EXPECT_TRUE(std::isfinite(affine[0][a][0]));
}

}  // namespace
}  // namespace mpm
