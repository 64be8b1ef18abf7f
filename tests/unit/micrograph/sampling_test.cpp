/// What locations larger or smaller than pixels make of the picture's density.

#include <cmath>

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

/// Bright walls of 3 pixels around square lumens of 17, with soft flanks: a coarse location that
/// holds the wall and its flanks reaches the threshold as a whole.
Rows thin_walls()
{
  Rows rows(120, std::vector<int>(160));
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < rows[j].size(); ++i) {
      const int across = std::min(std::abs(int(i % 20) - 8), std::abs(int(j % 20) - 11));
      rows[j][i] = across <= 1 ? 230 : across == 2 ? 130 : 20 + int(i * 7 + j * 3) % 16;
    }
  return rows;
}

class SampledPicture : public testing::Test {
 protected:
  SampledPicture()
  {
    scene_.materials = {{.name = "wall"}, {.name = "flank"}};
    scene_.specimen.micrograph.emplace();
    micrograph().file = directory_.write("picture.bmp", gray_bmp(thin_walls()));
    micrograph().pixel_size = {1e-6, 1e-6};
    scene_.grid.particles_per_cell = 1;
  }
  scene::Micrograph& micrograph() { return *scene_.specimen.micrograph; }
  Specimen<2> with_cells(int nx, int ny)
  {
    scene_.grid.cells = {nx, ny};
    return built(scene_);
  }
  TemporaryDirectory directory_;
  scene::Scene scene_;
};

TEST_F(SampledPicture, KeepsThePicturesDensityAtEveryResolution)
{
  for (const auto [nx, ny] : {std::array{37, 29}, {53, 41}, {97, 71}, {320, 240}}) {
    for (const auto wall : {scene::Wall::bright, scene::Wall::dark}) {
      micrograph().wall = wall;
      const Specimen<2> specimen = with_cells(nx, ny);
      // Means that are equal go together: a few locations of 1000 and more.
      EXPECT_NEAR(specimen.densities()[0].value, specimen.picture()->density, 0.005) << nx;
    }
  }
  // By the threshold of the pixels walls grow into their flanks: a tenth more particles.
  micrograph().wall = scene::Wall::bright;
  micrograph().sampling = scene::Sampling::threshold;
  const Specimen<2> coarse = with_cells(37, 29);
  EXPECT_GT(coarse.densities()[0].value, coarse.picture()->density + 0.02);
  EXPECT_EQ(coarse.picture()->location_threshold, 150);
}

TEST_F(SampledPicture, IsTheSameByEitherRuleWithOneLocationPerPixel)
{
  const Specimen<2> matched = with_cells(160, 120);
  const std::vector<std::int8_t> by_match = matched.lattice(matched.whole()).material;
  EXPECT_EQ(matched.densities()[0].value, matched.picture()->density);
  micrograph().sampling = scene::Sampling::threshold;
  EXPECT_EQ(materials_of(scene_), by_match);
}

TEST_F(SampledPicture, KeepsTheShareOfEveryBand)
{
  micrograph().bands = {{100, 200, "flank"}, {200, 256, "wall"}};
  const Specimen<2> pixels = with_cells(160, 120);
  for (const auto [nx, ny] : {std::array{53, 41}, {97, 71}}) {
    const Specimen<2> specimen = with_cells(nx, ny);
    for (std::size_t m = 0; m < 2; ++m)
      EXPECT_NEAR(double(specimen.particles_of_material()[m]) / double(specimen.locations()),
                  double(pixels.particles_of_material()[m]) / double(pixels.locations()), 0.005);
  }
}

TEST_F(SampledPicture, ADensityAimedAtRulesAndThePicturesIsToldAtItsThreshold)
{
  micrograph().threshold_rule = scene::ThresholdRule::target_relative_density;
  micrograph().target_relative_density = 0.25;
  const Specimen<2> specimen = with_cells(97, 71);
  EXPECT_NEAR(specimen.densities()[0].value, 0.25, 0.005);
  const double threshold = specimen.picture()->threshold;
  EXPECT_EQ(specimen.picture()->location_threshold, threshold);
  double above = 0;
  for (const auto& row : thin_walls())
    for (const int gray : row) above += gray >= threshold;
  EXPECT_EQ(specimen.picture()->density, above / (160 * 120));
}

TEST_F(SampledPicture, AShiftedThresholdIsThatOfItsRulePlusTheShift)
{
  const scene::Micrograph plain = micrograph();
  for (const auto rule : {scene::ThresholdRule::value, scene::ThresholdRule::otsu,
                          scene::ThresholdRule::target_relative_density}) {
    micrograph() = plain;
    micrograph().threshold_rule = rule;
    micrograph().target_relative_density = 0.25;
    const double found = with_cells(97, 71).picture()->threshold;
    micrograph().threshold_shift = -10;
    const Specimen<2> shifted = with_cells(97, 71);
    EXPECT_EQ(shifted.picture()->threshold, found - 10);
    micrograph() = plain;
    micrograph().sampling = rule == scene::ThresholdRule::target_relative_density
                                ? scene::Sampling::threshold
                                : scene::Sampling::match;
    micrograph().threshold = found - 10;
    EXPECT_EQ(with_cells(97, 71).particles_of_material(), shifted.particles_of_material());
  }
}

TEST_F(SampledPicture, OfWallOnlyIsFull)
{
  micrograph().threshold = 10;
  EXPECT_EQ(with_cells(37, 29).densities()[0].value, 1);
  micrograph().threshold = 240;
  EXPECT_THAT(message_of([&] { with_cells(37, 29); }), testing::StartsWith("no cell wall found"));
}

}  // namespace
}  // namespace mpm::micrograph::test
