#include <cmath>
#include <numbers>

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using std::numbers::sqrt3;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

scene::Scene scene_of(scene::PerAxis<double> size, scene::PerAxis<int> cells,
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
  return built(scene).densities()[0].value;
}

TEST(Shapes, ALocationIsFilledWhereItsCentreLiesInside)
{
  const auto specimen =
      built(scene_of({4, 2}, {4, 2}, {{scene::Box{{0.6, 0.4}, {2.6, 1.4}}, "soft"}}));
  const Lattice<2> lattice = specimen.lattice(specimen.whole());
  // Centres 0.5, 1.5, 2.5, 3.5 and 0.5, 1.5; only 1.5, 2.5 and 0.5 are inside.
  EXPECT_THAT(lattice.material, ElementsAre(-1, 0, 0, -1, -1, -1, -1, -1));
  EXPECT_THAT(lattice.shape, ElementsAre(-1, 0, 0, -1, -1, -1, -1, -1));
}

TEST(Shapes, LaterOnesOverrideAndVoidCuts)
{
  const auto specimen = built(scene_of({5, 1}, {5, 1},
                                       {{scene::Box{{0, 0}, {5, 1}}, "soft"},
                                        {scene::Box{{1, 0}, {4, 1}}, "hard"},
                                        {scene::Box{{2, 0}, {3, 1}}, "void"}}));
  const Lattice<2> lattice = specimen.lattice(specimen.whole());
  EXPECT_THAT(lattice.material, ElementsAre(0, 1, -1, 1, 0));
  EXPECT_THAT(lattice.shape, ElementsAre(0, 1, -1, 1, 0));
  EXPECT_EQ(specimen.particles(), 4);
  EXPECT_DOUBLE_EQ(specimen.densities()[0].value, 0.8);
  EXPECT_DOUBLE_EQ(specimen.densities()[0].bulk_density, (2 * 1000 + 2 * 3000) / 5.0);
}

TEST(Shapes, ShapesMayReachOutOfTheSpecimen)
{
  EXPECT_EQ(density_of(scene_of({1, 1}, {9, 9}, {{scene::Box{{-5, -5}, {5, 5}}, "soft"}})), 1);
}

TEST(Shapes, NeighbouringBoxesShareNoLocation)
{
  // The common edge runs through centres.
  EXPECT_THAT(materials_of(scene_of({4, 1}, {4, 1},
                                    {{scene::Box{{1.5, 0}, {4, 1}}, "hard"},
                                     {scene::Box{{0, 0}, {1.5, 1}}, "soft"}})),
              ElementsAre(0, 1, 1, 1));
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
  EXPECT_FALSE(star.contains({0, 0}));
  EXPECT_TRUE(star.contains({0, 0.8}));
  EXPECT_FALSE(star.contains({0.8, 0.8}));
}

TEST(Shapes, PolygonsThatShareASideShareNoPointAndLeaveNoneOut)
{
  // The square's diagonal runs through the centres of locations.
  const scene::Polygon lower{{{0, 0}, {1, 0}, {1, 1}}}, upper{{{1, 1}, {0, 1}, {0, 0}}};
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const scene::Point<2> point{(i + 0.5) / 10, (j + 0.5) / 10};
      EXPECT_NE(lower.contains(point), upper.contains(point)) << i << ' ' << j;
    }
}

// ---------------------------------------------------------------------------------- honeycomb

TEST(Honeycomb, HasItsHexagonsSidesWhereTheyBelong)
{
  const scene::Honeycomb comb{{0, 0}, {10, 10}, 1, 0.1};
  const double apothem = sqrt3 / 2;
  EXPECT_FALSE(comb.contains({0.01, 0.01}));           // centre of the first hexagon
  EXPECT_TRUE(comb.contains({apothem, 0}));            // middle of its right side
  EXPECT_TRUE(comb.contains({apothem - 0.049, 0.3}));  // within half the wall
  EXPECT_FALSE(comb.contains({apothem - 0.051, 0.3}));
  EXPECT_TRUE(comb.contains({apothem, 0.5}));       // corner where three walls meet
  EXPECT_FALSE(comb.contains({apothem, 1.5}));      // centre of the hexagon above
  EXPECT_TRUE(comb.contains({apothem / 2, 0.75}));  // middle of the slanted side
  EXPECT_FALSE(comb.contains({10.1, 0.5}));         // outside the box
}

TEST(Honeycomb, HasTheDensityOfRegularHexagons)
{
  // Two periods each way, t / l as tabulated for relative densities 0.2, 0.404 and 0.791. With 346
  // x 600 locations a wall line is misplaced by less than a location, and errors cancel: 0.5 %
  // of 1.
  for (const auto [wall, density] : {std::array{0.1829, 0.200}, {0.3949, 0.404}, {0.9402, 0.791}}) {
    const scene::Honeycomb comb{{0, 0}, {2 * sqrt3, 6}, 1, wall};
    EXPECT_NEAR(comb.relative_density(), density, 5e-4);
    EXPECT_NEAR(density_of(scene_of({2 * sqrt3, 6}, {347, 601}, {{comb, "soft"}})),
                comb.relative_density(), 5e-3);
  }
}

TEST(Honeycomb, IsAMirrorImageOfItselfAboutItsEdges)
{
  const auto specimen = built(scene_of(
      {2 * sqrt3, 6}, {100, 173}, {{scene::Honeycomb{{0, 0}, {2 * sqrt3, 6}, 1, 0.3}, "soft"}}));
  const Lattice<2> lattice = specimen.lattice(specimen.whole());
  int differences = 0;
  for (int j = 0; j < 173; ++j)
    for (int i = 0; i < 100; ++i) {
      differences += lattice({i, j}) != lattice({99 - i, j});
      differences += lattice({i, j}) != lattice({i, 172 - j});
    }
  EXPECT_EQ(differences, 0);
}

// ---------------------------------------------------------------------------------- mistakes

std::string error_of(scene::Shape shape)
{
  return message_of([&] { built(scene_of({1, 1}, {10, 10}, {std::move(shape)})); });
}

TEST(ShapeMistakes, AreNamedWithTheirPlace)
{
  EXPECT_EQ(error_of({scene::Box{{0, 0.5}, {1, 0.5}}, "soft"}),
            "specimen.shapes[0].box.upper: must be above lower along y.");
  EXPECT_EQ(error_of({scene::Polygon{{{0, 0}, {1, 1}}}, "soft"}),
            "specimen.shapes[0].polygon.vertices: a polygon has at least 3 vertices.");
  EXPECT_EQ(error_of({scene::Honeycomb{{0, 0}, {1, 1}, 0.1, 0.2}, "soft"}),
            "specimen.shapes[0].honeycomb.wall_thickness: must be below sqrt(3) cell_side, or no "
            "lumen is left.");
  EXPECT_EQ(error_of({scene::Sphere{{0, 0, 0}, 1}, "soft"}),
            "specimen.shapes[0] is a sphere, which has no place in the plane.");
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
  EXPECT_THAT(materials_of(scene), Each(0));
  scene.materials.clear();
  EXPECT_THAT(message_of([&] { built(scene); }), HasSubstr("materials is empty"));
}

}  // namespace
}  // namespace mpm::micrograph::test
