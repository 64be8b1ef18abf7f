// Two cells around a node whose corner closes: how near they are beside it.
#include <mpm/lagrangian/cell_overlaps.hpp>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// Of a unit cell turned clockwise by `angle` in the plane around its lower corner, which is at
/// `node`, and then by a quarter turn as often as `turns` says, around the origin.
template <int Dim>
std::vector<double> cell(Vec<Dim> node, double angle, int turns)
{
  CornerPlaces<Dim> places;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t corner = CellOverlaps<Dim>::order[k];
    double x = double(corner & 1), y = double(corner >> 1 & 1);
    // Which corner is which does not turn with them: where it was before.
    for (int turn = 0; turn < turns; ++turn) std::tie(x, y) = std::pair(y, 1 - x);
    Vec<Dim>& at = places[k] = node;
    at[0] += std::cos(angle) * x + std::sin(angle) * y;
    at[1] += std::cos(angle) * y - std::sin(angle) * x;
    if constexpr (Dim == 3) at[2] += double(corner >> 2);
    for (int turn = 0; turn < turns; ++turn) {
      std::swap(at[0], at[1]);
      at[0] = -at[0];
    }
  }
  std::vector<double> values(static_cast<std::size_t>(CellOverlaps<Dim>::values));
  CellOverlaps<Dim>::describe(places, values.data());
  return values;
}

template <int Dim>
void expect_the_width_of_the_corner()
{
  for (const double open : {80.0, 45.0, 10.0, 1.0})
    for (int turns = 0; turns < 4; ++turns) {
      const double radians = open * std::acos(-1.0) / 180, width = std::sin(radians);
      Vec<Dim> node = Vec<Dim>::Zero();
      node[0] = node[1] = -1;
      const std::vector<double> one = cell<Dim>(node, 0, turns),
                                other =
                                    cell<Dim>(Vec<Dim>::Zero(), std::acos(0.0) - radians, turns);
      IndexVec<Dim> apart = IndexVec<Dim>::Zero();
      apart[0] = turns == 0 || turns == 3 ? 1 : -1;
      apart[1] = turns < 2 ? 1 : -1;
      const auto closes = [&](double distance) {
        return CellOverlaps<Dim>::closes_on(other.data(), one.data(), -apart, distance) ||
               CellOverlaps<Dim>::closes_on(one.data(), other.data(), apart, distance);
      };
      EXPECT_TRUE(closes(width + 1e-9)) << open << ", " << turns;
      EXPECT_FALSE(closes(width - 1e-9)) << open << ", " << turns;
    }
}

TEST(ClosingCorner, IsAsWideAsTheNearestOtherCornerIsFar)
{
  expect_the_width_of_the_corner<2>();
}

TEST(ClosingCorner, IsSoAroundAnEdgeOfBricks)
{
  expect_the_width_of_the_corner<3>();
}

TEST(ClosingCorner, IsThatAroundANodeOfBricksToo)
{
  // Above each other as well: one node in common, and a corner of a right angle on all sides.
  const std::vector<double> one = cell<3>({-1, -1, -1}, 0, 0), other = cell<3>({0, 0, 0}, 0, 0);
  EXPECT_TRUE(CellOverlaps<3>::closes_on(one.data(), other.data(), {1, 1, 1}, 1 + 1e-9));
  EXPECT_FALSE(CellOverlaps<3>::closes_on(one.data(), other.data(), {1, 1, 1}, 1 - 1e-9));
}

}  // namespace
}  // namespace mpm
