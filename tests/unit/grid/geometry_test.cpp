#include <mpm/grid/grid_topology.hpp>

#include <gmock/gmock.h>

namespace mpm {
namespace {

TEST(IndexBox, CountsAndIntersects)
{
  const IndexBox<2> a{{0, 2}, {4, 6}}, b{{3, -1}, {9, 4}};
  const IndexBox<2> both{{3, 2}, {4, 4}};
  EXPECT_EQ(a.size(), 16);
  EXPECT_EQ(intersection(a, b), both);
  EXPECT_TRUE(a.contains({3, 5}));
  EXPECT_FALSE(a.contains({4, 5}));
}

TEST(IndexBox, OfBoxesApartIsEmpty)
{
  const IndexBox<3> a{{0, 0, 0}, {2, 2, 2}}, b{{0, 5, 0}, {2, 7, 2}};
  EXPECT_TRUE(intersection(a, b).empty());
  EXPECT_EQ(intersection(a, b).size(), 0);
}

TEST(GridGeometry, FindsTheCellOfAPositionWithItsOwnSpacingPerAxis)
{
  const GridGeometry<2> grid{{-1.0, 10.0}, {0.5, 0.25}, {20, 30}};
  EXPECT_EQ(grid.smallest_spacing(), 0.25);
  EXPECT_EQ(grid.cell_of({-1.0, 10.0}), IndexVec<2>(0, 0));
  EXPECT_EQ(grid.cell_of({0.74, 10.76}), IndexVec<2>(3, 3));
  EXPECT_EQ(grid.cell_of({-1.1, 9.9}), IndexVec<2>(-1, -1));  // floor, not towards zero
  EXPECT_EQ(grid.node_position(0, 3), 0.5);
  EXPECT_EQ(grid.node_position(1, 3), 10.75);
}

TEST(GridGeometry, FindsTheCellOfAPositionInSpace)
{
  const GridGeometry<3> grid{{0, 0, -4}, {1, 2, 4}, {9, 9, 9}};
  EXPECT_EQ(grid.cell_of({3.5, 3.5, 3.5}), IndexVec<3>(3, 1, 1));
}

TEST(GridTopology, NumbersItsNodesFromTheLowerCornerOfTheLocalBoxWithXFastest)
{
  const GridGeometry<3> geometry{{0, 0, 0}, {1, 1, 1}, {20, 20, 20}};
  const IndexBox<3> local{{3, 4, 5}, {6, 8, 10}};
  const GridTopology<3> grid(geometry, local, local);
  EXPECT_EQ(grid.size(), 3 * 4 * 5);
  EXPECT_EQ(grid.index_of({3, 4, 5}), 0);
  EXPECT_EQ(grid.index_of({4, 4, 5}), 1);
  EXPECT_EQ(grid.index_of({3, 5, 5}), 3);
  EXPECT_EQ(grid.index_of({3, 4, 6}), 12);
  EXPECT_EQ(grid.index_of({5, 7, 9}), 59);
}

}  // namespace
}  // namespace mpm
