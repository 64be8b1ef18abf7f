/// Walls made thicker or thinner where no threshold gives the density of the wood.

#include <mpm/micrograph/grown_walls.hpp>
#include <mpm/micrograph/threshold.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using scene::ThresholdRule;
using scene::Wall;

GrayImage speckled(int width, int height)
{
  GrayImage image{width, height, {}, {}};
  for (int k = 0; k < width * height; ++k)
    image.gray.push_back((k * 7919 % 101) < 8 ? 180 + k % 20 : 40 + k % 30);
  return image;
}

/// From the definition: every pixel looked at from every other one.
double level_of(const GrayImage& image, int column, int row, const GrayClasses& classes, Wall wall,
                const std::array<double, 2>& pixel)
{
  const bool inside = is_wall(image(column, row), classes.threshold, wall);
  double nearest = std::numeric_limits<double>::infinity();
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i)
      if (is_wall(image(i, j), classes.threshold, wall) != inside)
        nearest = std::min(nearest, std::hypot((i - column) * pixel[0], (j - row) * pixel[1]));
  const double depth = nearest / std::sqrt(pixel[0] * pixel[1]) - 0.5;
  const double contrast = classes.bright - classes.dark;
  const double order = std::clamp((image(column, row) - classes.threshold) / contrast, -0.5, 0.5);
  return ((wall == Wall::bright ? 1 : -1) * (inside ? depth : -depth) + order) * contrast / 2;
}

TEST(GrownWalls, LevelsAreDistancesFromTheSurface)
{
  const GrayImage image = speckled(37, 29);
  const GrayClasses classes = gray_classes(image);
  const std::array<double, 2> pixel{2e-6, 1.5e-6};
  for (const Wall wall : {Wall::bright, Wall::dark}) {
    const GrownWalls grown = grown_walls(image, classes, wall, pixel);
    EXPECT_GE(std::ranges::min(grown.image.gray), 0);
    for (int row = 0; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column)
        ASSERT_NEAR(grown.image(column, row) - grown.surface,
                    level_of(image, column, row, classes, wall, pixel), 1e-9);
  }
}

TEST(GrownWalls, AtTheSurfaceAreTheWallsOfOtsusThreshold)
{
  const GrayImage image = speckled(37, 29);
  const GrayClasses classes = gray_classes(image);
  for (const Wall wall : {Wall::bright, Wall::dark}) {
    const GrownWalls grown = grown_walls(image, classes, wall, {1e-6, 1e-6});
    EXPECT_EQ(grown.growth(grown.surface), 0);
    EXPECT_GT(grown.growth(grown.surface + (wall == Wall::bright ? -1 : 1)), 0);
    for (std::size_t k = 0; k < image.gray.size(); ++k)
      EXPECT_EQ(is_wall(grown.image.gray[k], grown.surface, wall),
                is_wall(image.gray[k], classes.threshold, wall));
  }
}

/// A ring of wall, two grays only, that any threshold between them leaves as it is.
class RingOfTwoGrays : public testing::Test {
 protected:
  static constexpr int size = 240;
  static constexpr double inner = 60, outer = 80;
  RingOfTwoGrays()
  {
    Rows rows(size, std::vector<int>(size, 30));
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        const double radius = std::hypot(i + 0.5 - size / 2, j + 0.5 - size / 2);
        if (radius > inner && radius < outer) rows[std::size_t(j)][std::size_t(i)] = 220;
      }
    scene_.materials = {scene::Material{.name = "wall", .values = {{"density", 1500.0}}}};
    auto& micrograph = scene_.specimen.micrograph.emplace();
    micrograph.file = directory_.write("ring.bmp", gray_bmp(rows));
    micrograph.pixel_size = {1e-6, 1e-6};
    scene_.grid.cells = {60, 60};
  }
  static double share(double grown)
  {
    return std::numbers::pi * (std::pow(outer + grown, 2) - std::pow(inner - grown, 2)) /
           (size * size);
  }
  Specimen<2> aimed_at(double relative_density)
  {
    scene_.specimen.micrograph->threshold_rule = ThresholdRule::target_relative_density;
    scene_.specimen.micrograph->target_relative_density = relative_density;
    return built(scene_);
  }
  TemporaryDirectory directory_;
  scene::Scene scene_;
};

TEST_F(RingOfTwoGrays, GrowsAndShrinksToTheDensityAskedFor)
{
  for (const double grown : {-7.0, -4.0, 5.0, 9.0}) {
    const Specimen<2> specimen = aimed_at(share(grown));
    EXPECT_NEAR(specimen.densities()[0].value, share(grown), 0.003);
    EXPECT_NEAR(specimen.picture()->growth, grown * 1e-6, 0.6e-6);
  }
}

TEST_F(RingOfTwoGrays, TellsHowThickAShiftedThresholdLeavesThem)
{
  const double aimed = aimed_at(share(5)).picture()->growth;
  for (const double shift : {-190.0, 190.0}) {
    scene_.specimen.micrograph->threshold_shift = shift;
    const Specimen<2> specimen = aimed_at(share(5));
    const double growth = specimen.picture()->growth;
    EXPECT_GT(std::abs(growth - aimed), 1e-6) << shift;
    // As near as above: 0.6 um all around are 0.0092 of it.
    EXPECT_NEAR(specimen.densities()[0].value, share(growth * 1e6), 0.0092) << shift;
  }
}

TEST_F(RingOfTwoGrays, StaysAsItIsWhereAThresholdGivesTheDensity)
{
  EXPECT_EQ(aimed_at(share(0)).picture()->growth, 0);
  EXPECT_EQ(aimed_at(share(0)).densities()[0].value, [&] {
    scene_.specimen.micrograph->threshold_rule = ThresholdRule::otsu;
    return built(scene_).densities()[0].value;
  }());
}

TEST_F(RingOfTwoGrays, IsTheSameOnAnyNumberOfParts)
{
  const Specimen<2> alone = aimed_at(share(6));
  const std::vector<std::int8_t> materials = alone.lattice(alone.whole()).material;
  on_parts(3, [&](const Share& part) {
    const Specimen<2> shared = built(scene_, part);
    EXPECT_EQ(shared.picture()->growth, alone.picture()->growth);
    EXPECT_EQ(shared.lattice(shared.whole()).material, materials);
  });
}

TEST_F(RingOfTwoGrays, ADensityOfTheWoodIsOneRelativeToThatOfItsWall)
{
  const Specimen<2> relative = aimed_at(share(5));
  scene_.specimen.micrograph->threshold_rule = ThresholdRule::target_density;
  scene_.specimen.micrograph->target_density = share(5) * 1500;
  EXPECT_EQ(built(scene_).particles(), relative.particles());
  scene_.specimen.micrograph->target_density = 1500;
  EXPECT_THAT(message_of([&] { built(scene_); }),
              testing::HasSubstr("specimen.threshold.target_density is 1500 kg/m^3, and the cell "
                                 "wall has 1500."));
}

}  // namespace
}  // namespace mpm::micrograph::test
