#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/share.hpp>

#include <algorithm>
#include <functional>

#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using testing::HasSubstr;

TEST(CellCounts, FoundingPapersLatticeHas58200Locations)
{
  scene::Grid grid;
  grid.cells = {150, 97};
  const IndexVec<2> cells = cell_counts<2>(grid, {0.832e-3, 0.541e-3});
  const IndexVec<2> count = location_counts<2>(cells, 2, 1);
  EXPECT_EQ(count, IndexVec<2>(300, 194));
  EXPECT_EQ(count.prod(), 58200);
}

TEST(CellCounts, SpacingIsRoundedPerAxisToWholeCells)
{
  scene::Grid grid;
  grid.spacing = {3e-6, 4e-6};
  EXPECT_EQ(cell_counts<2>(grid, {100e-6, 90e-6}), IndexVec<2>(33, 23));  // 33.3 and 22.5
  grid.spacing = {1, 1};
  EXPECT_EQ(cell_counts<2>(grid, {100e-6, 90e-6}), IndexVec<2>(1, 1));
}

TEST(CellCounts, DefaultIs150AlongXAndNearlySquare)
{
  EXPECT_EQ(cell_counts<2>({}, {1.5e-3, 0.806e-3}), IndexVec<2>(150, 81));
  EXPECT_EQ(cell_counts<2>({}, {1e-3, 4e-3}), IndexVec<2>(150, 600));
}

TEST(CellCounts, DefaultInSpaceIs150AlongXAndNearlyCubes)
{
  EXPECT_EQ(cell_counts<3>({}, {1.5e-3, 0.806e-3, 0.1e-3}), IndexVec<3>(150, 81, 10));
}

TEST(CellCounts, MistakesAreNamed)
{
  scene::Grid grid;
  grid.cells = {150, 0};
  EXPECT_EQ(message_of([&] {
              cell_counts<2>(grid, {1, 1});
            }),
            "grid.cells[1] is 0 (must be at least 1).");
  grid.spacing = {1e-6, 1e-6};
  EXPECT_THAT(message_of([&] { cell_counts<2>(grid, {1, 1}); }), HasSubstr("both given"));
  grid.cells.reset();
  grid.spacing = {1e-12, 1};
  EXPECT_EQ(message_of([&] {
              cell_counts<2>(grid, {1, 1});
            }),
            "grid.spacing[0] is 1e-12 m, which makes 1e+12 cells along x. Give a coarser one.");
  grid.spacing = {1, -1};
  EXPECT_EQ(message_of([&] {
              cell_counts<2>(grid, {1, 1});
            }),
            "grid.spacing[1] is -1 m (must be above 0).");
  EXPECT_EQ(message_of([&] {
              location_counts<2>({1, 1}, 0, 1);
            }),
            "grid.particles_per_cell is 0 (must be at least 1).");
  EXPECT_THAT(message_of([&] {
                location_counts<2>({100000, 100000}, 2, 1);
              }),
              HasSubstr("4e+10 in all (at most 2147483647 per rank). Give fewer, or use more "
                        "ranks."));
  EXPECT_EQ(location_counts<2>({100000, 100000}, 2, 20), IndexVec<2>(200000, 200000));
}

TEST(Lattice, NumbersOfAPartAreThoseOfTheWhole)
{
  const IndexBox<3> part{{1, 2, 3}, {4, 4, 5}};
  const Lattice<3> lattice{{5, 6, 7}, part, {}, {}};
  std::size_t place = 0;
  for_each_index(part, [&](const IndexVec<3>& at) {
    EXPECT_EQ(lattice.place(at), place++);
    EXPECT_EQ(lattice.id(at), at[0] + 5 * (at[1] + 6 * at[2]));
  });
}

TEST(Lattice, NumbersBeyondTwoThousandMillion)
{
  const Lattice<2> lattice{{100000, 100000}, {{0, 99999}, {100000, 100000}}, {}, {}};
  EXPECT_EQ(lattice.id({99999, 99999}), 9999999999);
}

TEST(Slabs, MakeUpTheBoxAndDifferByOneLayerAtMost)
{
  const IndexBox<2> box{{2, 3}, {5, 14}};
  for (const int parts : {1, 2, 4, 11, 30}) {
    LocalIndex next = box.lower[1];
    for (int part = 0; part < parts; ++part) {
      const IndexBox<2> own = slab(box, part, parts);
      EXPECT_EQ(own.lower, IndexVec<2>(2, next));
      EXPECT_NEAR(own.upper[1] - next, 11.0 / parts, 1 - 1e-9);
      next = own.upper[1];
    }
    EXPECT_EQ(next, box.upper[1]);
  }
}

TEST(Chunks, MakeUpTheBoxInOrderAndAreBounded)
{
  const IndexBox<3> box{{0, 1, 2}, {5, 8, 4}};
  for (const GlobalIndex most : {1, 3, 5, 12, 35, 100}) {
    std::vector<LocalIndex> numbers;
    for_each_chunk(box, most, [&](const IndexBox<3>& chunk) {
      EXPECT_LE(chunk.size(), most);
      for_each_index(chunk, [&](const IndexVec<3>& at) { numbers.push_back(number_in(box, at)); });
    });
    ASSERT_EQ(numbers.size(), std::size_t(box.size()));
    EXPECT_TRUE(std::ranges::is_sorted(numbers, std::less_equal{}));
  }
}

}  // namespace
}  // namespace mpm::micrograph::test
