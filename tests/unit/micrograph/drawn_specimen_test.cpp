/// Specimens whose picture is drawn from a description of the wood.

#include "built_specimen.hpp"
#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

scene::Scene scene_of(const std::string& picture)
{
  scene::Scene scene;
  scene.materials = {scene::Material{.name = "wall", .values = {{"density", 1500.0}}}};
  scene.specimen.micrograph.emplace().file = MPM_INPUTS_DIR "/wood/" + picture;
  scene.grid.cells = {75, 49};
  return scene;
}

TEST(DrawnSpecimen, IsThatOfThePictureDrawnBefore)
{
  scene::Scene file = scene_of("loblolly.bmp");
  file.specimen.micrograph->image_size = {832e-6, 541e-6};
  const scene::Scene drawing = scene_of("loblolly.anatomy.yaml");
  EXPECT_EQ(materials_of(drawing), materials_of(file));
  EXPECT_NEAR(built(drawing).size()[0], 832e-6, 1e-12);
  EXPECT_NEAR(built(drawing).size()[1], 541e-6, 1e-12);
}

TEST(DrawnSpecimen, OfAnotherSeedIsAnotherPieceOfTheSameDensity)
{
  scene::Scene drawing = scene_of("loblolly.anatomy.yaml");
  const Specimen<2> first = built(drawing);
  drawing.specimen.micrograph->seed = 11;
  const Specimen<2> second = built(drawing);
  EXPECT_NE(first.lattice(first.whole()).material, second.lattice(second.whole()).material);
  EXPECT_NEAR(second.densities()[0].value, first.densities()[0].value, 0.01);
}

TEST(DrawnSpecimen, SaysWhatIsWrongWithItsDescription)
{
  const TemporaryDirectory directory;
  const std::string text = "picture: {width_px: -3}\n";
  scene::Scene drawing = scene_of("");
  drawing.specimen.micrograph->file =
      directory.write("own.anatomy.yaml", Bytes(text.begin(), text.end()));
  EXPECT_THAT(message_of([&] { built(drawing); }),
              testing::AllOf(testing::HasSubstr("own.anatomy.yaml"),
                             testing::HasSubstr("picture.width_px")));
}

}  // namespace
}  // namespace mpm::micrograph::test
