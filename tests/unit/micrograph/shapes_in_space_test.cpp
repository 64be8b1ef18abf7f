#include <cmath>
#include <numbers>

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using std::numbers::pi;
using std::numbers::sqrt3;
using testing::ElementsAre;

scene::Scene scene_of(scene::PerAxis<double> size, scene::PerAxis<int> cells,
                      std::vector<scene::Shape> shapes)
{
  scene::Scene scene;
  scene.dimensions = 3;
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
  return built<3>(scene).densities()[0].value;
}

TEST(ShapesInSpace, ALocationIsFilledWhereItsCentreLiesInside)
{
  const auto specimen =
      built<3>(scene_of({2, 2, 2}, {2, 2, 2}, {{scene::Box{{0, 1, 0}, {2, 2, 1}}, "soft"}}));
  EXPECT_THAT(specimen.lattice(specimen.whole()).material, ElementsAre(-1, -1, 0, 0,  //
                                                                       -1, -1, -1, -1));
}

TEST(ShapesInSpace, LaterOnesOverrideAndTheirSpeedsCount)
{
  const std::vector<scene::Shape> shapes{{scene::Box{{0, 0, 0}, {4, 1, 2}}, "soft", {0, 0, 7}},
                                         {scene::Box{{0, 0, 0}, {4, 1, 1}}, "hard", {0, -5, 1}},
                                         {scene::Box{{0, 0, 1}, {4, 1, 2}}, "void"}};
  const auto specimen = built<3>(scene_of({4, 1, 2}, {4, 1, 2}, shapes));
  EXPECT_THAT(specimen.particles_of_material(), ElementsAre(0, 4));
  EXPECT_EQ(specimen.largest_initial_speed(), 5);  // nothing is left of the first shape
  EXPECT_EQ(specimen.densities()[0].bulk_density, 1500);
}

TEST(ShapesInSpace, SphereHasItsVolume)
{
  // 100 locations across: the surface misses by less than a location, and errors cancel.
  EXPECT_NEAR(density_of(scene_of({1, 1, 1}, {100, 100, 100},
                                  {{scene::Sphere{{0.5, 0.5, 0.5}, 0.4}, "soft"}})),
              4.0 / 3 * pi * 0.064, 5e-4);
}

TEST(ShapesInSpace, SlantedHollowCylinderHasItsVolume)
{
  const scene::Cylinder cylinder{{0.3, 0.3, 0.3}, {0.7, 0.6, 0.8}, 0.2, 0.1};
  const double length = std::hypot(0.4, 0.3, 0.5);
  EXPECT_NEAR(density_of(scene_of({1, 1, 1}, {100, 100, 100}, {{cylinder, "soft"}})),
              pi * (0.04 - 0.01) * length, 1e-3);
}

TEST(ShapesInSpace, CylinderReachesAsFarAsItsExtentAndNoFurther)
{
  // A disc across (1, 1, 0): its rim reaches radius / sqrt(2) along x and y, the radius along z.
  const scene::Cylinder cylinder{{0, 0, 0}, {1, 1, 0}, 2, 0};
  const scene::Extent extent = cylinder.extent();
  EXPECT_THAT(extent.lower, ElementsAre(-std::sqrt(2.0), -std::sqrt(2.0), -2));
  EXPECT_THAT(extent.upper, ElementsAre(1 + std::sqrt(2.0), 1 + std::sqrt(2.0), 2));
  EXPECT_TRUE(cylinder.contains({0, 0, 1.999}));
  EXPECT_TRUE(cylinder.contains({-1.41, 1.41, 0}));
  EXPECT_FALSE(cylinder.contains({-0.01, -0.01, 0}));  // before the first end
  EXPECT_FALSE(cylinder.contains({1, 1, 0}));          // the last end
}

TEST(ShapesInSpace, TubesAreTheHoneycombDrawnOutAlongTheirAxis)
{
  const scene::Honeycomb comb{{0, 0}, {2 * sqrt3, 6}, 1, 0.3};
  const std::array axes{scene::Axis::x, scene::Axis::y, scene::Axis::z};
  for (std::size_t along = 0; along < 3; ++along) {
    const std::size_t a = along == 0 ? 1 : 0, b = along == 2 ? 1 : 2;
    scene::Tubes tubes{{0, 0, 0}, {0, 0, 0}, 1, 0.3, axes[along]};
    tubes.upper[along] = 1;
    tubes.upper[a] = comb.upper[0];
    tubes.upper[b] = comb.upper[1];
    for (int j = -1; j < 61; ++j)
      for (int i = -1; i < 36; ++i) {
        const scene::Point<2> in_section{0.1 * i + 0.03, 0.1 * j + 0.04};
        scene::Point<3> point{};
        point[a] = in_section[0];
        point[b] = in_section[1];
        point[along] = 0.5;
        EXPECT_EQ(tubes.contains(point), comb.contains(in_section)) << along;
        point[along] = 1.5;
        EXPECT_FALSE(tubes.contains(point));
      }
  }
}

TEST(ShapesInSpace, WindowsCountAlongZToo)
{
  scene::Scene scene = scene_of({1, 1, 4}, {2, 2, 4}, {{scene::Box{{0, 0, 0}, {1, 1, 1}}, "soft"}});
  scene.specimen.windows = {{.name = "back", .z = {0, 0.5}}};
  EXPECT_EQ(built<3>(scene).densities()[1].value, 0.5);
  scene.specimen.windows[0].z = {0.9, 0.95};
  EXPECT_EQ(message_of([&] { built<3>(scene); }),
            "specimen.windows[0] 'back' is x [0, 1], y [0, 1], z [0.9, 0.95] and contains no "
            "location. Give growing fractions between 0 and 1.");
}

TEST(ShapesInSpace, ShapesOfThePlaneHaveNoPlaceThere)
{
  EXPECT_EQ(message_of([] {
              built<3>(scene_of({1, 1, 1}, {9, 9, 9}, {{scene::Disc{{0, 0}, 1}, "soft"}}));
            }),
            "specimen.shapes[0] is a disc, which has no place in space.");
}

}  // namespace
}  // namespace mpm::micrograph::test
