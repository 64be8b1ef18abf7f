/// Specimens whose picture is drawn from a description of the wood.

#include <mpm/micrograph/anatomy_drawing.hpp>

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

TEST(DrawnSpecimen, OfCellsThatEndIsAStackInWhichLumensClose)
{
  anatomy::Parameters wood = anatomy::read_parameters(MPM_INPUTS_DIR "/wood/loblolly.anatomy.yaml");
  const anatomy::Drawing section = anatomy::draw(wood, 2);
  ASSERT_GT(section.lumens.size(), 100u);
  // Each cell ends once within the depth, and is as the section shows it away from there.
  wood.grain = anatomy::Grain{.cell_length = 100, .taper = 10};
  constexpr int slices = 25;
  const std::vector<std::uint8_t> stack = anatomy::draw_slices(wood, 2, 100, slices);
  ASSERT_EQ(stack.size(), slices * section.gray.size());
  std::vector<int> ends_in(slices);
  for (const anatomy::Point& lumen : section.lumens) {
    const std::size_t pixel =
        std::size_t(lumen.y) * std::size_t(section.width) + std::size_t(lumen.x);
    if (section.gray[pixel] > 100) continue;  // too narrow to be dark
    int closed = 0, as_shown = 0;
    for (int k = 0; k < slices; ++k) {
      const int gray = stack[std::size_t(k) * section.gray.size() + pixel];
      if (gray > 150) {
        ++closed;
        ++ends_in[std::size_t(k)];
      }
      as_shown += gray == section.gray[pixel];
    }
    EXPECT_GE(closed, 1);
    EXPECT_LE(closed, 6);  // of 4 um each, at most the taper either way
    EXPECT_GE(as_shown, slices - 6);
  }
  EXPECT_GT(std::ranges::count_if(ends_in, [](int cells) { return cells > 0; }), 20);

  // The shipped wood is such a stack in space, and a section in the plane.
  scene::Scene scene = scene_of("loblolly.anatomy.yaml");
  const double in_section = built(scene).densities()[0].value;
  scene.dimensions = 3;
  scene.specimen.micrograph->depth = 24e-6;
  scene.grid.cells = {75, 49, 2};
  EXPECT_EQ(read_picture(scene)->image.slices, 10);
  const double in_stack = built<3>(scene).densities()[0].value;
  EXPECT_GT(in_stack, in_section);
  EXPECT_LT(in_stack, in_section + 0.02);
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
