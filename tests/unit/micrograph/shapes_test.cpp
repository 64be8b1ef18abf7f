#include <mpm/micrograph/geometry.hpp>
#include <mpm/micrograph/specimen.hpp>

#include <cmath>
#include <numbers>

#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using std::numbers::sqrt3;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

scene::Scene scene_of(std::array<double, 2> size, std::array<int, 2> cells,
                      std::vector<scene::Shape> shapes)
{
  scene::Scene scene;
  scene.materials = {scene::Material{.name = "soft", .values = {{"density", 1000.0}}},
                     scene::Material{.name = "hard", .values = {{"density", 3000.0}}}};
  scene.specimen.size = size;
  scene.specimen.shapes = std::move(shapes);
  scene.grid.cells = cells;
  scene.grid.particles_per_cell = 1;
  return scene;
}

double density_of(const scene::Scene& scene)
{
  return build_specimen(scene).densities[0].value;
}

TEST(Shapes, ALocationIsFilledWhereItsCentreLiesInside)
{
  const auto model =
      build_specimen(scene_of({4, 2}, {4, 2}, {{scene::Box{{0.6, 0.4}, {2.6, 1.4}}, "soft"}}));
  // Centres 0.5, 1.5, 2.5, 3.5 and 0.5, 1.5; only 1.5, 2.5 and 0.5 are inside.
  EXPECT_THAT(model.lattice.material, ElementsAre(-1, 0, 0, -1, -1, -1, -1, -1));
  EXPECT_THAT(model.lattice.shape, ElementsAre(-1, 0, 0, -1, -1, -1, -1, -1));
}

TEST(Shapes, LaterOnesOverrideAndVoidCuts)
{
  const auto model = build_specimen(scene_of({5, 1}, {5, 1},
                                             {{scene::Box{{0, 0}, {5, 1}}, "soft"},
                                              {scene::Box{{1, 0}, {4, 1}}, "hard"},
                                              {scene::Box{{2, 0}, {3, 1}}, "void"}}));
  EXPECT_THAT(model.lattice.material, ElementsAre(0, 1, -1, 1, 0));
  EXPECT_THAT(model.lattice.shape, ElementsAre(0, 1, -1, 1, 0));
  EXPECT_EQ(model.particles(), 4);
  EXPECT_DOUBLE_EQ(model.densities[0].value, 0.8);
  EXPECT_DOUBLE_EQ(model.densities[0].bulk_density, (2 * 1000 + 2 * 3000) / 5.0);
}

TEST(Shapes, ShapesMayReachOutOfTheSpecimen)
{
  EXPECT_EQ(density_of(scene_of({1, 1}, {9, 9}, {{scene::Box{{-5, -5}, {5, 5}}, "soft"}})), 1);
}

TEST(Shapes, NeighbouringBoxesShareNoLocation)
{
  // The common edge runs through centres.
  const auto model = build_specimen(
      scene_of({4, 1}, {4, 1},
               {{scene::Box{{1.5, 0}, {4, 1}}, "hard"}, {scene::Box{{0, 0}, {1.5, 1}}, "soft"}}));
  EXPECT_THAT(model.lattice.material, ElementsAre(0, 1, 1, 1));
}

TEST(Shapes, DiscHasTheAreaOfACircle)
{
  // 400 locations across: the outline misses by at most about one location per 100 of its length.
  const double density =
      density_of(scene_of({1, 1}, {400, 400}, {{scene::Disc{{0.5, 0.5}, 0.4}, "soft"}}));
  EXPECT_NEAR(density, std::numbers::pi * 0.16, 5e-4);
}

TEST(Shapes, PolygonFollowsTheEvenOddRule)
{
  // A pentagram drawn in one stroke: its points are inside, its middle is not.
  scene::Polygon star;
  for (int k = 0; k < 5; ++k) {
    const double angle = (90 + 144 * k) * std::numbers::pi / 180;
    star.vertices.push_back({std::cos(angle), std::sin(angle)});
  }
  EXPECT_FALSE(contains(star, {0, 0}));
  EXPECT_TRUE(contains(star, {0, 0.8}));
  EXPECT_FALSE(contains(star, {0.8, 0.8}));
}

TEST(Shapes, PolygonsThatShareASideShareNoPointAndLeaveNoneOut)
{
  // The square's diagonal runs through the centres of locations.
  const scene::Polygon lower{{{0, 0}, {1, 0}, {1, 1}}}, upper{{{1, 1}, {0, 1}, {0, 0}}};
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const Point point{(i + 0.5) / 10, (j + 0.5) / 10};
      EXPECT_NE(contains(lower, point), contains(upper, point)) << i << ' ' << j;
    }
}

// ---------------------------------------------------------------------------------- honeycomb

TEST(Honeycomb, HasItsHexagonsSidesWhereTheyBelong)
{
  const scene::Honeycomb comb{{0, 0}, {10, 10}, 1, 0.1};
  const double apothem = sqrt3 / 2;
  EXPECT_FALSE(contains(comb, {0.01, 0.01}));           // centre of the first hexagon
  EXPECT_TRUE(contains(comb, {apothem, 0}));            // middle of its right side
  EXPECT_TRUE(contains(comb, {apothem - 0.049, 0.3}));  // within half the wall
  EXPECT_FALSE(contains(comb, {apothem - 0.051, 0.3}));
  EXPECT_TRUE(contains(comb, {apothem, 0.5}));       // corner where three walls meet
  EXPECT_FALSE(contains(comb, {apothem, 1.5}));      // centre of the hexagon above
  EXPECT_TRUE(contains(comb, {apothem / 2, 0.75}));  // middle of the slanted side
  EXPECT_FALSE(contains(comb, {10.1, 0.5}));         // outside the box
}

TEST(Honeycomb, HasTheDensityOfRegularHexagons)
{
  // Two periods each way, t / l as tabulated for relative densities 0.2, 0.404 and 0.791. With 346
  // x 600 locations a wall line is misplaced by less than a location, and errors cancel: 0.5 %
  // of 1.
  for (const auto [wall, density] : {std::array{0.1829, 0.200}, {0.3949, 0.404}, {0.9402, 0.791}}) {
    const scene::Honeycomb comb{{0, 0}, {2 * sqrt3, 6}, 1, wall};
    EXPECT_NEAR(relative_density(comb), density, 5e-4);
    EXPECT_NEAR(density_of(scene_of({2 * sqrt3, 6}, {347, 601}, {{comb, "soft"}})),
                relative_density(comb), 5e-3);
  }
}

TEST(Honeycomb, IsAMirrorImageOfItselfAboutItsEdges)
{
  const auto model = build_specimen(scene_of(
      {2 * sqrt3, 6}, {100, 173}, {{scene::Honeycomb{{0, 0}, {2 * sqrt3, 6}, 1, 0.3}, "soft"}}));
  int differences = 0;
  for (int j = 0; j < 173; ++j)
    for (int i = 0; i < 100; ++i) {
      differences += model.lattice(i, j) != model.lattice(99 - i, j);
      differences += model.lattice(i, j) != model.lattice(i, 172 - j);
    }
  EXPECT_EQ(differences, 0);
}

// ---------------------------------------------------------------------------------- mistakes

std::string error_of(scene::Shape shape)
{
  return message_of([&] { build_specimen(scene_of({1, 1}, {10, 10}, {std::move(shape)})); });
}

TEST(ShapeMistakes, AreNamedWithTheirPlace)
{
  EXPECT_EQ(error_of({scene::Box{{0, 0.5}, {1, 0.5}}, "soft"}),
            "specimen.shapes[0]: lower[1] is 0.5 m and upper[1] is 0.5 m (lower must be below "
            "upper).");
  EXPECT_EQ(error_of({scene::Disc{{0, 0}, 0}, "soft"}),
            "specimen.shapes[0]: radius is 0 m (must be above 0).");
  EXPECT_EQ(error_of({scene::Polygon{{{0, 0}, {1, 1}}}, "soft"}),
            "specimen.shapes[0]: vertices are 2 (a polygon needs at least 3).");
  EXPECT_EQ(error_of({scene::Honeycomb{{0, 0}, {1, 1}, 0, 0.1}, "soft"}),
            "specimen.shapes[0]: cell_side is 0 m (must be above 0).");
  EXPECT_THAT(error_of({scene::Honeycomb{{0, 0}, {1, 1}, 0.1, 0.2}, "soft"}),
              HasSubstr("wall_thickness is 0.2 m (must lie between 0 and sqrt(3) cell_side"));
  EXPECT_THAT(error_of({scene::Box{{0.01, 0.01}, {0.04, 0.04}}, "soft"}),
              HasSubstr("specimen.shapes[0] contains no particle location"));
  EXPECT_THAT(error_of({scene::Box{{0, 0}, {1, 1}}, "void"}), HasSubstr("no location is filled"));
}

TEST(ShapeMistakes, UnknownMaterialBringsTheNearestName)
{
  EXPECT_EQ(error_of({scene::Box{{0, 0}, {1, 1}}, "sofd"}),
            "specimen.shapes[0].material is 'sofd', an unknown material (did you mean 'soft'?).");
  EXPECT_EQ(error_of({scene::Box{{0, 0}, {1, 1}}, ""}),
            "specimen.shapes[0].material is missing. Name one of: soft, hard.");
}

TEST(Shapes, TheOnlyMaterialNeedsNoName)
{
  scene::Scene scene = scene_of({1, 1}, {2, 2}, {{scene::Box{{0, 0}, {1, 1}}, ""}});
  scene.materials.resize(1);
  EXPECT_THAT(build_specimen(scene).lattice.material, Each(0));
  scene.materials.clear();
  EXPECT_THAT(message_of([&] { build_specimen(scene); }), HasSubstr("materials is empty"));
}

}  // namespace
}  // namespace mpm::micrograph::test
