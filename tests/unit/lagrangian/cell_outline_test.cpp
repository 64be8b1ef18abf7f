// Corners of a cell that stand off its nodes.
#include <mpm/lagrangian/cell_outline.hpp>

#include <gtest/gtest.h>

namespace mpm {
namespace {

using Corners = std::array<Vec<2>, CellOutline::corners>;

const Corners rest{Vec<2>(0.1, -0.2), Vec<2>(1.3, 0.1), Vec<2>(0.9, 0.8), Vec<2>(-0.1, 1.1)},
    ways{Vec<2>(-0.2, -0.1), Vec<2>(0.1, 0.3), Vec<2>(0, 0), Vec<2>(-0.1, -0.2)};

double cross(const Vec<2>& a, const Vec<2>& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

TEST(CellOutline, IsNoneWhereAllWaysAreZero)
{
  Corners none;
  none.fill(Vec<2>::Zero());
  EXPECT_FALSE(CellOutline::at(rest, none));
}

TEST(CellOutline, IsDeformedWithTheCell)
{
  const auto outline = CellOutline::at(rest, ways);
  Eigen::Matrix2d f;
  f << 1.2, 0.4, -0.3, 0.7;
  const Vec<2> moved(3, -5);
  Corners places;
  for (std::size_t k = 0; k < 4; ++k) places[k] = moved + f * rest[k];
  outline->take_corners(places);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT((places[k] - moved - f * (rest[k] + ways[k])).norm(), 1e-14);
}

TEST(CellOutline, GivesItsNodesTheSameForceMomentAndWork)
{
  const auto outline = CellOutline::at(rest, ways);
  const Corners pushes{Vec<2>(1, 2), Vec<2>(-3, 0.5), Vec<2>(0.2, -0.7), Vec<2>(4, 1)},
      motion{Vec<2>(0.3, 2), Vec<2>(1, -0.5), Vec<2>(-2, 0.7), Vec<2>(0.1, 1)};
  Corners on_nodes = pushes, corners = rest, velocities = motion;
  outline->give_nodes(on_nodes);
  outline->take_corners(corners);
  outline->take_corners(velocities);
  Vec<2> force = Vec<2>::Zero();
  double moment = 0, power = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    force += on_nodes[k] - pushes[k];
    moment += cross(rest[k], on_nodes[k]) - cross(corners[k], pushes[k]);
    power += motion[k].dot(on_nodes[k]) - velocities[k].dot(pushes[k]);
  }
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_NEAR(moment, 0, 1e-14);
  EXPECT_NEAR(power, 0, 1e-14);
}

TEST(CellOutline, MovesNoFartherThanItsReach)
{
  const auto outline = CellOutline::at(rest, ways);
  EXPECT_GT(outline->reach(), 1);
  // Against each other, by one each.
  double farthest = 0;
  for (unsigned signs = 0; signs < 16; ++signs) {
    std::array<double, 4> way;
    for (unsigned k = 0; k < 4; ++k) way[k] = signs >> k & 1 ? 1 : -1;
    outline->take_corners(way);
    for (const double of_corner : way) farthest = std::max(farthest, std::abs(of_corner));
  }
  EXPECT_NEAR(farthest, outline->reach(), 1e-14);
}

}  // namespace
}  // namespace mpm
