#include <mpm/micrograph/wall_thickness.hpp>

#include "built_specimen.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

/// Cells of 1 m with 2 x 2 locations.
scene::Scene scene_of(int cells, std::vector<scene::Shape> shapes)
{
  scene::Scene scene;
  scene.materials = {scene::Material{.name = "wall", .values = {{"density", 1000.0}}}};
  const double size = cells;
  scene.specimen.size = {size, size, size};
  scene.specimen.shapes = std::move(shapes);
  scene.grid.cells = {cells, cells, cells};
  scene.grid.particles_per_cell = 2;
  return scene;
}

/// The same for any number of parts.
template <int Dim = 2>
ThinCount thin_in(const scene::Scene& scene)
{
  const ThinCount alone =
      count_thin(built<Dim>(scene), std::span(scene.materials), thin_wall_cells, Share{});
  for (const int parts : {2, 3, 7})
    on_parts(parts, [&](const Share& share) {
      const ThinCount count =
          count_thin(built<Dim>(scene, share), std::span(scene.materials), thin_wall_cells, share);
      EXPECT_EQ(count.filled, alone.filled);
      EXPECT_EQ(count.thin, alone.thin);
    });
  return alone;
}

scene::Shape wall(double from, double to)
{
  return {scene::Box{{from, 0, 0}, {to, 100, 100}}, "wall"};
}

TEST(WallThickness, AWallOfTwoCellsIsNotThinAndOneOfAHalfLessIsAllOfIt)
{
  EXPECT_EQ(thin_in(scene_of(12, {wall(3, 5)})).thin, 0);
  const ThinCount thin = thin_in(scene_of(12, {wall(3, 4.5), wall(7, 10)}));
  EXPECT_EQ(thin.filled, (3 + 6) * 24);
  EXPECT_EQ(thin.thin, 3 * 24);
  EXPECT_EQ(thin_in<3>(scene_of(6, {wall(3, 5)})).thin, 0);
  EXPECT_EQ(thin_in<3>(scene_of(6, {wall(3, 4.5)})).thin, 3 * 12 * 12);
}

TEST(WallThickness, OfWhatIsOneCellThickItselfIsThatOfItsMirrorImages)
{
  for (const int particles_per_cell : {1, 2, 4}) {
    scene::Scene strip = scene_of(12, {wall(0, 12)});
    strip.specimen.size[1] = strip.specimen.size[2] = 1;
    strip.grid.cells = {12, 1, 1};
    strip.grid.particles_per_cell = particles_per_cell;
    EXPECT_EQ(thin_in(strip).thin, 0) << particles_per_cell;
    const ThinCount all = thin_in<3>(strip);
    EXPECT_EQ(all.thin, 0) << particles_per_cell;
    EXPECT_EQ(all.filled, 12 * std::pow(particles_per_cell, 3));
    strip.specimen.shapes = {wall(3, 4.5)};
    const ThinCount narrow = thin_in(strip);
    if (particles_per_cell > 1) {
      EXPECT_EQ(narrow.thin, narrow.filled) << particles_per_cell;
    }
  }
}

TEST(WallThickness, AWallAcrossTheDiagonalIsMeasuredAcrossItself)
{
  const auto oblique = [](double thickness) {
    // Along x = y, its faces thickness / sqrt(2) off along each axis.
    const double h = thickness / std::sqrt(2.0);
    return scene_of(
        24,
        {{scene::Polygon{{{-40, -40 + h}, {-40 + h, -40}, {40, 40 - h}, {40 - h, 40}}}, "wall"}});
  };
  const ThinCount thin = thin_in(oblique(1.4)), thick = thin_in(oblique(2.7));
  // At its ends it meets its mirror image.
  EXPECT_GT(double(thin.thin), 0.9 * double(thin.filled));
  EXPECT_EQ(thick.thin, 0);
}

TEST(WallThickness, AWallThatTheBorderCutsIsNotThinForThat)
{
  EXPECT_EQ(thin_in(scene_of(12, {wall(0, 1), wall(11, 12)})).thin, 0);
  EXPECT_EQ(thin_in(scene_of(12, {wall(0, 0.5), wall(11, 12)})).thin, 24);
}

TEST(WallThickness, WhatIsRigidFillsAndDoesNotCount)
{
  scene::Scene scene = scene_of(12, {wall(3, 4.5), wall(4.5, 5)});
  scene.materials.push_back({.name = "rigid", .law = "rigid", .values = {}});
  scene.specimen.shapes[1].material = "rigid";
  const ThinCount count = thin_in(scene);
  EXPECT_EQ(count.filled, 3 * 24);
  EXPECT_EQ(count.thin, 0);
}

TEST(WallThickness, CornersOfThickWallsAreAFewLocations)
{
  const ThinCount count = thin_in(scene_of(30, {{scene::Box{{5, 5}, {25, 25}}, "wall"}}));
  EXPECT_EQ(count.filled, 40 * 40);
  EXPECT_EQ(count.thin, 4);
}

}  // namespace
}  // namespace mpm::micrograph::test
