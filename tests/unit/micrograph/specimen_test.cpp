#include <mpm/core/error.hpp>
#include <mpm/micrograph/preview.hpp>

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// Scenes of a picture with pixels of 1 um, one location per pixel unless changed. Locations are
/// wall by the pixels' threshold.
class SpecimenOfPicture : public testing::Test {
 protected:
  scene::Scene scene_of(const Rows& rows)
  {
    scene::Scene scene;
    scene.materials = {scene::Material{.name = "wall", .values = {{"density", 1500.0}}}};
    scene.specimen.micrograph.emplace();
    scene.specimen.micrograph->file = directory_.write("picture.bmp", gray_bmp(rows));
    scene.specimen.micrograph->pixel_size = {1e-6, 1e-6};
    scene.specimen.micrograph->sampling = scene::Sampling::threshold;
    scene.grid.cells = {int(rows.front().size()), int(rows.size())};
    scene.grid.particles_per_cell = 1;
    return scene;
  }
  static std::string error_of(const scene::Scene& scene)
  {
    return message_of([&] { built(scene); });
  }
  static std::vector<int> filled(const scene::Scene& scene)
  {
    const std::vector<std::int8_t> materials = materials_of(scene);
    return {materials.begin(), materials.end()};
  }
  TemporaryDirectory directory_;
};

TEST_F(SpecimenOfPicture, TopRowOfTheImageIsTheTopOfTheSpecimen)
{
  EXPECT_THAT(filled(scene_of({{200, 0, 0},  //
                               {0, 0, 150}})),
              ElementsAre(-1, -1, 0,  //
                          0, -1, -1));
}

TEST_F(SpecimenOfPicture, DarkWallsAreTheComplementOfBrightOnes)
{
  scene::Scene scene = scene_of({{149, 150, 151}});
  EXPECT_THAT(filled(scene), ElementsAre(-1, 0, 0));
  scene.specimen.micrograph->wall = scene::Wall::dark;
  EXPECT_THAT(filled(scene), ElementsAre(0, -1, -1));
}

TEST_F(SpecimenOfPicture, CropRotationAndFlipsComeInThisOrder)
{
  scene::Scene scene = scene_of({{200, 9, 9, 9},  //
                                 {9, 200, 200, 9},
                                 {9, 9, 200, 9}});
  scene::Micrograph& micrograph = *scene.specimen.micrograph;
  micrograph.crop = {1, 1, 3, 2};  // 200 200 9 / 9 200 9
  scene.grid.cells = {3, 2};
  EXPECT_THAT(filled(scene), ElementsAre(-1, 0, -1,  //
                                         0, 0, -1));
  micrograph.rotate = 90;  // 9 9 / 200 200 / 200 9
  scene.grid.cells = {2, 3};
  EXPECT_THAT(filled(scene), ElementsAre(0, -1,  //
                                         0, 0,   //
                                         -1, -1));
  micrograph.flip_horizontal = true;
  EXPECT_THAT(filled(scene), ElementsAre(-1, 0,  //
                                         0, 0,   //
                                         -1, -1));
  micrograph.flip_vertical = true;
  EXPECT_THAT(filled(scene), ElementsAre(-1, -1,  //
                                         0, 0,    //
                                         -1, 0));
}

// ------------------------------------------------------------------------------------- size

TEST_F(SpecimenOfPicture, ImageSizeIsThatOfTheWholeImageAndTurnsWithIt)
{
  scene::Scene scene = scene_of(Rows(10, std::vector<int>(20, 200)));
  scene::Micrograph& micrograph = *scene.specimen.micrograph;
  micrograph.pixel_size.reset();
  micrograph.image_size = {0.832e-3, 0.541e-3};
  EXPECT_EQ(built(scene).size(), Vec<2>(0.832e-3, 0.541e-3));
  micrograph.rotate = 270;
  EXPECT_EQ(built(scene).size(), Vec<2>(0.541e-3, 0.832e-3));
  micrograph.crop = {0, 0, 5, 10};
  EXPECT_EQ(built(scene).size(), Vec<2>(0.541e-3, 0.25 * 0.832e-3));
}

TEST_F(SpecimenOfPicture, PixelSizeCountsThePixelsOfTheCrop)
{
  scene::Scene scene = scene_of(Rows(10, std::vector<int>(20, 200)));
  scene.specimen.micrograph->pixel_size = {2e-6, 3e-6};
  scene.specimen.micrograph->crop = {2, 3, 4, 5};
  const Vec<2> size = built(scene).size();
  EXPECT_DOUBLE_EQ(size[0], 8e-6);
  EXPECT_DOUBLE_EQ(size[1], 15e-6);
}

TEST_F(SpecimenOfPicture, SizeMustBeKnownOnceAndAboveZero)
{
  scene::Scene scene = scene_of({{200}});
  scene::Micrograph& micrograph = *scene.specimen.micrograph;
  micrograph.image_size = {1e-3, 1e-3};
  EXPECT_THAT(error_of(scene), HasSubstr("image_size and specimen.pixel_size are both given"));
  micrograph.pixel_size.reset();
  micrograph.image_size = {1e-3, 0};
  EXPECT_THAT(error_of(scene), HasSubstr("the image is 0.001 x 0 m (must be above 0)"));
  micrograph.image_size.reset();
  EXPECT_EQ(error_of(scene), micrograph.file.string() +
                                 ": the size of the image is unknown. Give specimen.image_size or "
                                 "specimen.pixel_size.");
}

// ------------------------------------------------------------------------------------- wall

TEST_F(SpecimenOfPicture, LocationsSmallerThanPixelsInheritTheirWall)
{
  scene::Scene scene = scene_of({{200, 10}});
  scene.grid.particles_per_cell = 2;
  EXPECT_THAT(filled(scene), ElementsAre(0, 0, -1, -1, 0, 0, -1, -1));
}

TEST_F(SpecimenOfPicture, OtsuPartsThePixelsOfTheCrop)
{
  scene::Scene scene = scene_of({{60, 60, 180, 0, 0, 255}});
  scene.specimen.micrograph->threshold_rule = scene::ThresholdRule::otsu;
  scene.specimen.micrograph->crop = {0, 0, 3, 1};
  scene.grid.cells = {3, 1};
  EXPECT_EQ(built(scene).picture()->threshold, 120);  // of 61 ... 180
  EXPECT_THAT(filled(scene), ElementsAre(-1, -1, 0));
}

TEST_F(SpecimenOfPicture, TargetRelativeDensityIsMetAndItsThresholdReproducesIt)
{
  Rows rows(30, std::vector<int>(30));
  for (int pixel = 0; pixel < 900; ++pixel)
    rows[std::size_t(pixel / 30)][std::size_t(pixel % 30)] = pixel * 211 % 256;
  scene::Scene scene = scene_of(rows);
  scene.grid.cells = {20, 20};  // 1.5 pixels: means of many levels
  scene::Micrograph& micrograph = *scene.specimen.micrograph;
  micrograph.threshold_rule = scene::ThresholdRule::target_relative_density;
  micrograph.target_relative_density = 0.404;
  for (const auto wall : {scene::Wall::bright, scene::Wall::dark}) {
    micrograph.wall = wall;
    micrograph.threshold_rule = scene::ThresholdRule::target_relative_density;
    const std::vector<std::int8_t> aimed = materials_of(scene);
    EXPECT_NEAR(built(scene).densities()[0].value, 0.404, 1.0 / 400);
    micrograph.threshold = built(scene).picture()->threshold;
    micrograph.threshold_rule = scene::ThresholdRule::value;
    EXPECT_EQ(materials_of(scene), aimed);
  }
}

TEST_F(SpecimenOfPicture, NoWallIsAnErrorThatTellsTheGrayRange)
{
  scene::Scene scene = scene_of({{20, 90}});
  scene.file = "inputs/dark.yaml";
  EXPECT_EQ(error_of(scene),
            "inputs/dark.yaml: no cell wall found: the gray of the locations lies between 20.0 and "
            "90.0, specimen.threshold is 150.0 and walls are bright. Lower the threshold, or set "
            "specimen.wall: dark.");
  scene.specimen.micrograph->wall = scene::Wall::dark;
  scene.specimen.micrograph->threshold = 20;
  EXPECT_THAT(error_of(scene),
              EndsWith("walls are dark. Raise the threshold, or set specimen.wall: "
                       "bright."));
}

TEST_F(SpecimenOfPicture, FileErrorsBeginWithTheSceneAndNameTheImage)
{
  scene::Scene scene = scene_of({{200}});
  scene.file = "inputs/scene.yaml";
  scene.specimen.micrograph->file = directory_ / "lost.bmp";
  EXPECT_THAT(error_of(scene),
              StartsWith("inputs/scene.yaml: " + (directory_ / "lost.bmp").string() +
                         ": cannot be opened (No such file or directory)."));
}

TEST_F(SpecimenOfPicture, ImageAndShapesExcludeEachOther)
{
  scene::Scene scene = scene_of({{200}});
  scene.specimen.shapes = {{scene::Box{{0, 0}, {1, 1}}, ""}};
  EXPECT_THAT(error_of(scene), HasSubstr("micrograph and specimen.shapes are both given"));
  scene.specimen.micrograph.reset();
  EXPECT_EQ(error_of(scene), "specimen.size[0] is 0 m (must be above 0).");
  scene.specimen.shapes.clear();
  EXPECT_THAT(error_of(scene), StartsWith("specimen is empty. Give specimen.micrograph"));
}

// ------------------------------------------------------------------------------------- cleaning

TEST_F(SpecimenOfPicture, SpecksAndLoosePiecesAreRemovedAndCounted)
{
  scene::Scene scene = scene_of({{200, 0, 200, 200, 0, 200, 200, 200}});
  scene::Micrograph& micrograph = *scene.specimen.micrograph;
  EXPECT_EQ(built(scene).picture()->removed, 0);
  micrograph.remove_specks = 2;
  EXPECT_EQ(built(scene).picture()->removed, 1);
  EXPECT_THAT(filled(scene), ElementsAre(-1, -1, 0, 0, -1, 0, 0, 0));
  micrograph.remove_unconnected = true;
  const Specimen<2> specimen = built(scene);
  EXPECT_EQ(specimen.picture()->removed, 3);
  EXPECT_EQ(specimen.particles(), 3);
  EXPECT_EQ(specimen.densities()[0].value, 3.0 / 8);  // of what is left
  micrograph.remove_specks = 4;
  EXPECT_THAT(error_of(scene), StartsWith("no cell wall left: every piece has fewer than "
                                          "specimen.remove_specks = 4 locations."));

  scene.motion = scene::FreeMotion{
      1, {"periodic", "periodic", "free", "free", "free", "free"}, {}};  // the last meets the first
  EXPECT_THAT(filled(scene), ElementsAre(0, -1, -1, -1, -1, 0, 0, 0));
  micrograph.remove_unconnected = false;
  micrograph.remove_specks = 0;
  EXPECT_EQ(built(scene).picture()->unconnected, 2);
}

// ------------------------------------------------------------------------------------- bands

TEST_F(SpecimenOfPicture, BandsMapGrayRangesToMaterials)
{
  scene::Scene scene = scene_of({{99, 100, 179, 180, 255}});
  scene.materials = {scene::Material{.name = "lamella", .values = {{"density", 1400.0}}},
                     scene::Material{.name = "wall", .values = {{"density", 1500.0}}}};
  scene.specimen.micrograph->bands = {{180, 256, "wall"}, {100, 180, "lamella"}};
  EXPECT_THAT(materials_of(scene), ElementsAre(-1, 0, 0, 1, 1));
  const Specimen<2> specimen = built(scene);
  EXPECT_THAT(specimen.particles_of_material(), ElementsAre(2, 2));
  EXPECT_DOUBLE_EQ(specimen.densities()[0].bulk_density, (2 * 1400 + 2 * 1500) / 5.0);
  EXPECT_EQ(specimen.picture()->threshold, 0);
  EXPECT_EQ(specimen.picture()->density, 0.8);
}

TEST_F(SpecimenOfPicture, BandMistakesAreNamed)
{
  scene::Scene scene = scene_of({{99}});
  auto& bands = scene.specimen.micrograph->bands;
  bands = {{50, 50, "wall"}};
  EXPECT_EQ(error_of(scene), "specimen.bands[0] is from 50 to 50 (from must be below to).");
  bands = {{50, 100, "wall"}, {99, 120, "wall"}};
  EXPECT_EQ(
      error_of(scene),
      "specimen.bands[1] from 99 to 120 overlaps specimen.bands[0] from 50 to 100. Part them.");
  bands = {{50, 100, "wal"}};
  EXPECT_EQ(error_of(scene),
            "specimen.bands[0].material is 'wal', an unknown material (did you mean 'wall'?).");
  bands = {{150, 256, "wall"}};
  EXPECT_THAT(error_of(scene), HasSubstr("between 99.0 and 99.0, outside every entry of "
                                         "specimen.bands"));
}

// ------------------------------------------------------------------------------------- windows

TEST_F(SpecimenOfPicture, WindowsCountTheLocationsWhoseCentresTheyHold)
{
  scene::Scene scene = scene_of({{0, 0, 200, 200},  //
                                 {0, 200, 200, 200}});
  scene.specimen.windows = {{"left", {0, 0.5}, {0, 1}}, {"top right", {0.5, 1}, {0.5, 1}}};
  const auto densities = built(scene).densities();
  ASSERT_EQ(densities.size(), 3u);
  EXPECT_EQ(densities[0].window, "");
  EXPECT_EQ(densities[0].value, 5.0 / 8);
  EXPECT_DOUBLE_EQ(densities[0].bulk_density, 1500 * 5.0 / 8);
  EXPECT_EQ(densities[1].window, "left");
  EXPECT_EQ(densities[1].value, 0.25);
  EXPECT_EQ(densities[2].value, 1);
}

TEST_F(SpecimenOfPicture, WindowThatHoldsNothingIsAnError)
{
  scene::Scene scene = scene_of({{200, 200}});
  scene.specimen.windows = {{"late", {0.9, 0.1}, {0, 1}}};
  EXPECT_THAT(error_of(scene),
              StartsWith("specimen.windows[0] 'late' is x [0.9, 0.1], y [0, 1] and "
                         "contains no location."));
}

// ------------------------------------------------------------------------------------- preview

TEST_F(SpecimenOfPicture, PreviewShowsWallWhiteAndVoidBlackTheRightWayUp)
{
  const Rows picture{{200, 0, 0},  //
                     {0, 0, 200}};
  const auto file = directory_ / "preview.png";
  write_preview(built(scene_of(picture)), file);
  const GrayImage preview = read_image(file);
  EXPECT_EQ(preview.width, 3);
  EXPECT_THAT(preview.gray, ElementsAre(255, 0, 0, 0, 0, 255));
}

TEST_F(SpecimenOfPicture, PreviewTellsMaterialsApart)
{
  scene::Scene scene = scene_of({{0, 100, 200, 150}});
  scene.materials = {{.name = "a"}, {.name = "b"}, {.name = "c"}};
  scene.specimen.micrograph->bands = {{90, 110, "a"}, {140, 160, "c"}, {190, 256, "b"}};
  write_preview(built(scene), directory_ / "preview.png");
  EXPECT_THAT(read_image(directory_ / "preview.png").gray, ElementsAre(0, 255, 176, 96));
}

TEST_F(SpecimenOfPicture, PreviewOfALongLatticeShowsEverySecondLocation)
{
  const scene::Scene scene = scene_of({{0, 0, 200, 0, 200},  //
                                       {0, 200, 0, 200, 0},
                                       {200, 0, 0, 0, 200}});
  write_preview(built(scene), directory_ / "preview.png", 4);
  const GrayImage preview = read_image(directory_ / "preview.png");
  EXPECT_EQ(preview.width, 3);
  EXPECT_THAT(preview.gray, ElementsAre(0, 255, 255, 255, 0, 255));
}

TEST_F(SpecimenOfPicture, PreviewThatCannotBeWrittenIsAFileError)
{
  EXPECT_THROW(write_preview(built(scene_of({{200}})), directory_ / "nowhere" / "preview.png"),
               FileError);
}

}  // namespace
}  // namespace mpm::micrograph::test
