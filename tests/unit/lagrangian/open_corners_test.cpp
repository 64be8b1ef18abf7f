// Across which edges and corners neighbours can come to meet.
#include <mpm/lagrangian/open_corners.hpp>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// A cell at the origin of a full lattice from which one other is missing.
template <int Dim>
OpenCorners<Dim> without(const IndexVec<Dim>& missing)
{
  return {IndexVec<Dim>::Zero(), [&](const IndexVec<Dim>& at) { return at != missing; }};
}

template <int Dim, class Expected>
void expect_open(const OpenCorners<Dim>& open, const Expected& is_open)
{
  const IndexVec<Dim> one = IndexVec<Dim>::Constant(1);
  for_each_index(IndexBox<Dim>{-one, 2 * one}, [&](const IndexVec<Dim>& way) {
    if (way.cwiseAbs().sum() < 2) return;
    EXPECT_EQ(open.towards(way), is_open(way)) << way.transpose();
  });
}

TEST(OpenCorners, AreNoneInAFullLattice)
{
  EXPECT_TRUE(without<2>({2, 0}).is_behind());
  EXPECT_TRUE(without<3>({0, 0, 2}).is_behind());
  expect_open(without<2>({2, 0}), [](const IndexVec<2>&) { return false; });
  expect_open(without<3>({0, 0, 2}), [](const IndexVec<3>&) { return false; });
}

TEST(OpenCorners, AreThoseAroundAFaceWithNothingBehind)
{
  EXPECT_FALSE(without<2>({0, -1}).is_behind());
  EXPECT_FALSE(without<3>({1, 0, 0}).is_behind());
  expect_open(without<2>({0, -1}), [](const IndexVec<2>& way) { return way[1] < 0; });
  expect_open(without<3>({1, 0, 0}), [](const IndexVec<3>& way) { return way[0] > 0; });
}

/// Of an edge only what lies across its two ends; the cell is behind the outer layer.
TEST(OpenCorners, AreAtTheEndsOfAnEdgeWithNothingAcross)
{
  EXPECT_TRUE(without<3>({1, -1, 0}).is_behind());
  expect_open(without<3>({1, -1, 0}),
              [](const IndexVec<3>& way) { return way[0] == 1 && way[1] == -1 && way[2] != 0; });
}

TEST(OpenCorners, GoIntoANumberAndBack)
{
  const OpenCorners<3> open = without<3>({0, 1, 0}), back(open.bits());
  expect_open(back, [&](const IndexVec<3>& way) { return open.towards(way); });
  EXPECT_FALSE(back.is_behind());
  EXPECT_FALSE(OpenCorners<2>::all().is_behind());
}

}  // namespace
}  // namespace mpm
