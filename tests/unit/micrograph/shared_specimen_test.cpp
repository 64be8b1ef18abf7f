/// Specimens are the same on any number of parts, and any part of them can be rastered alone.

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

/// A noisy picture: walls on a lattice of squares, with specks in the lumens and gaps in the walls.
Rows noisy_picture()
{
  Rows rows(41, std::vector<int>(53));
  unsigned state = 12345;
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < rows[j].size(); ++i) {
      state = state * 1664525u + 1013904223u;
      const int wall = i % 9 < 3 || j % 8 < 3 ? 150 : 60;
      rows[j][i] = wall + int(state >> 24) * 2 / 5;
    }
  return rows;
}

class SharedSpecimen : public testing::Test {
 protected:
  SharedSpecimen()
  {
    scene_.materials = {scene::Material{.name = "wall", .values = {{"density", 1500.0}}},
                        scene::Material{.name = "ray", .values = {{"density", 1400.0}}}};
    scene_.specimen.micrograph.emplace();
    micrograph().file = directory_.write("picture.bmp", gray_bmp(noisy_picture()));
    micrograph().pixel_size = {1e-6, 1e-6};
    scene_.specimen.windows = {{.name = "middle", .x = {0.3, 0.7}, .y = {0.2, 0.8}}};
    scene_.grid.cells = {21, 17, 3};
  }
  scene::Micrograph& micrograph() { return *scene_.specimen.micrograph; }

  template <int Dim>
  void expect_same_on_any_number_of_parts()
  {
    const Specimen<Dim> alone = built<Dim>(scene_);
    const Lattice<Dim> whole = alone.lattice(alone.whole());
    for (const int parts : {2, 3, 7, 50}) {  // more parts than rows too
      on_parts(parts, [&](const Share& share) {
        const Specimen<Dim> shared = built<Dim>(scene_, share);
        static std::mutex one_at_a_time;
        const std::lock_guard lock(one_at_a_time);
        EXPECT_EQ(shared.particles_of_material(), alone.particles_of_material());
        EXPECT_EQ(shared.largest_initial_speed(), alone.largest_initial_speed());
        for (std::size_t w = 0; w < 2; ++w) {
          EXPECT_EQ(shared.densities()[w].value, alone.densities()[w].value);
          EXPECT_EQ(shared.densities()[w].bulk_density, alone.densities()[w].bulk_density);
        }
        ASSERT_EQ(shared.picture().has_value(), alone.picture().has_value());
        if (alone.picture()) {
          EXPECT_EQ(shared.picture()->location_threshold, alone.picture()->location_threshold);
          EXPECT_EQ(shared.picture()->density, alone.picture()->density);
          EXPECT_EQ(shared.picture()->removed, alone.picture()->removed);
        }
        IndexBox<Dim> box = shared.whole();
        box.lower[0] = 5;
        box.upper[0] = 31;
        box.lower[1] = 1 + share.part % 20;
        box.upper[1] = 30;
        const Lattice<Dim> part = shared.lattice(box);
        for_each_index(box, [&](const IndexVec<Dim>& at) {
          ASSERT_EQ(part(at), whole(at)) << at.transpose();
          if (!whole.shape.empty()) {
            ASSERT_EQ(part.shape[part.place(at)], whole.shape[whole.place(at)]);
          }
        });
      });
    }
  }

  TemporaryDirectory directory_;
  scene::Scene scene_;
};

TEST_F(SharedSpecimen, OfAPictureByThreshold)
{
  micrograph().sampling = scene::Sampling::threshold;
  expect_same_on_any_number_of_parts<2>();
}

TEST_F(SharedSpecimen, OfAPictureWithItsDensityOrTheOneAimedAt)
{
  expect_same_on_any_number_of_parts<2>();
  micrograph().threshold_rule = scene::ThresholdRule::target_relative_density;
  micrograph().target_relative_density = 0.37;
  expect_same_on_any_number_of_parts<2>();
}

TEST_F(SharedSpecimen, OfAPictureWithBands)
{
  micrograph().bands = {{140, 200, "ray"}, {200, 256, "wall"}};
  expect_same_on_any_number_of_parts<2>();
}

TEST_F(SharedSpecimen, WithoutSpecksAndLoosePieces)
{
  micrograph().threshold = 215;
  for (const int specks : {0, 3, 12})
    for (const bool unconnected : {false, true}) {
      micrograph().remove_specks = specks;
      micrograph().remove_unconnected = unconnected;
      expect_same_on_any_number_of_parts<2>();
    }
  EXPECT_GT(built(scene_).picture()->removed, 0);
}

TEST_F(SharedSpecimen, HasTheDensityAimedAtOnceSpecksAndLoosePiecesAreGone)
{
  micrograph().remove_specks = 3;
  micrograph().remove_unconnected = true;
  micrograph().sampling = scene::Sampling::threshold;
  const auto missed = [&](double aim) {
    const Specimen<2> specimen = built(scene_);
    return std::abs(double(specimen.particles()) - aim * double(specimen.whole().size()));
  };
  for (const double aim : {0.28, 0.37, 0.45}) {
    micrograph().threshold_rule = scene::ThresholdRule::value;
    double least = 1e9;  // of all thresholds: a loose piece comes and goes as a whole
    for (micrograph().threshold = 100; micrograph().threshold < 215; micrograph().threshold += 0.25)
      least = std::min(least, missed(aim));
    micrograph().threshold_rule = scene::ThresholdRule::target_relative_density;
    micrograph().target_relative_density = aim;
    EXPECT_LE(missed(aim), least + 1) << aim;
    EXPECT_GT(built(scene_).picture()->removed, 0) << aim;
    EXPECT_EQ(built(scene_).picture()->aim, aim);
    expect_same_on_any_number_of_parts<2>();
  }
}

TEST_F(SharedSpecimen, OfAPictureDrawnOutIntoSpace)
{
  scene_.dimensions = 3;
  micrograph().depth = 3e-6;
  micrograph().remove_specks = 3;
  expect_same_on_any_number_of_parts<3>();
  const Specimen<3> specimen = built<3>(scene_);
  EXPECT_EQ(specimen.size(), Vec<3>(53e-6, 41e-6, 3e-6));
  const Specimen<2> section = built<2>(scene_);
  EXPECT_EQ(specimen.particles(), 6 * section.particles());
  EXPECT_EQ(specimen.picture()->removed, 6 * section.picture()->removed);
}

TEST_F(SharedSpecimen, OfAStack)
{
  scene_.dimensions = 3;
  scene_.grid.cells = {21, 17, 4};
  micrograph().depth = 5e-6;
  for (int slice = 0; slice < 5; ++slice) {  // walls that wander to the right
    Rows rows = noisy_picture();
    for (auto& row : rows) std::rotate(row.begin(), row.end() - 2 * slice, row.end());
    directory_.write("slice_" + std::to_string(8 + slice) + ".bmp", gray_bmp(rows));
  }
  micrograph().file = directory_ / "slice_*.bmp";
  micrograph().threshold = 205;
  for (const int specks : {0, 30})
    for (const bool unconnected : {false, true}) {
      micrograph().remove_specks = specks;
      micrograph().remove_unconnected = unconnected;
      expect_same_on_any_number_of_parts<3>();
    }
  EXPECT_GT(built<3>(scene_).picture()->removed, 0);
  micrograph().bands = {{140, 200, "ray"}, {200, 256, "wall"}};
  expect_same_on_any_number_of_parts<3>();
}

TEST_F(SharedSpecimen, OfAStackOfEqualSlicesIsThePictureDrawnOut)
{
  scene_.dimensions = 3;
  micrograph().depth = 3e-6;
  const auto drawn_out = materials_of<3>(scene_);
  for (int slice = 0; slice < 4; ++slice)
    directory_.write("equal_" + std::to_string(slice) + ".bmp", gray_bmp(noisy_picture()));
  micrograph().file = directory_ / "equal_*.bmp";
  EXPECT_EQ(materials_of<3>(scene_), drawn_out);
  EXPECT_EQ(built<3>(scene_).size(), Vec<3>(53e-6, 41e-6, 3e-6));
}

TEST_F(SharedSpecimen, WallsOfAStackAreNotGrown)
{
  scene_.dimensions = 3;
  micrograph().depth = 2e-6;
  for (const char* name : {"two_0.bmp", "two_1.bmp"}) {
    Rows rows(20, std::vector<int>(20, 40));
    for (auto& row : rows) std::fill_n(row.begin(), 8, 200);
    directory_.write(name, gray_bmp(rows));
  }
  micrograph().file = directory_ / "two_*.bmp";
  micrograph().threshold_rule = scene::ThresholdRule::target_relative_density;
  micrograph().target_relative_density = 0.4;
  EXPECT_NEAR(built<3>(scene_).densities()[0].value, 0.4, 0.01);
  micrograph().target_relative_density = 0.7;
  on_parts(2, [&](const Share& share) {
    EXPECT_THAT(message_of([&] { built<3>(scene_, share); }),
                testing::EndsWith("gives a relative density of 0.7; the walls of a stack are not "
                                  "made thicker or thinner. Give another density, or a "
                                  "threshold."));
  });
}

TEST_F(SharedSpecimen, OfShapesInSpace)
{
  scene_.dimensions = 3;
  scene_.specimen.micrograph.reset();
  scene_.specimen.size = {21, 17, 3};
  scene_.specimen.shapes = {{scene::Box{{0, 0, 0}, {21, 17, 3}}, "wall", {1, 2, 3}},
                            {scene::Sphere{{10, 9, 1}, 6}, "ray", {-4, 0, 0}},
                            {scene::Box{{0, 0, 2.5}, {21, 17, 3}}, "void"}};
  expect_same_on_any_number_of_parts<3>();
}

TEST_F(SharedSpecimen, AllPartsRefuseAShapeWithoutLocations)
{
  scene_.specimen.micrograph.reset();
  scene_.specimen.size = {21, 17};
  scene_.specimen.shapes = {{scene::Disc{{10, 8}, 3}, "wall"}, {scene::Disc{{5, 5}, 0.01}, "wall"}};
  on_parts(3, [&](const Share& share) {
    EXPECT_THAT(message_of([&] { built(scene_, share); }),
                testing::StartsWith("specimen.shapes[1] contains no particle location of the "
                                    "specimen (21 x 17 m, lattice 42 x 34)."));
  });
}

}  // namespace
}  // namespace mpm::micrograph::test
