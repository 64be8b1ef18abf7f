#include <sstream>

#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;

using SceneDefaults = SceneFolder;

TEST_F(SceneDefaults, SixLinesCrushAMicrograph)
{
  const Scene scene = read(smallest);
  EXPECT_EQ(scene.name, "a");
  EXPECT_EQ(scene.specimen.micrograph->file, folder_ / "wood.png");
  EXPECT_THAT(*scene.specimen.micrograph->pixel_size, ElementsAre(2.3e-6, 2.3e-6));
  EXPECT_EQ(scene.specimen.micrograph->threshold, 150);
  EXPECT_EQ(scene.grid.particles_per_cell, 2);
  EXPECT_EQ(scene.numerics.shape_function, "gimp");
  EXPECT_EQ(scene.numerics.cfl, std::nullopt);
  EXPECT_EQ(std::get<Loading>(scene.motion).speed, 10);
  EXPECT_EQ(std::get<Loading>(scene.motion).strain, 0.6);
}

TEST_F(SceneDefaults, WoodUnderAPistonIsCrushedByCells)
{
  using enum FormulationKind;
  const auto formulation = [&](const std::string& text, const std::vector<std::string>& set = {}) {
    return read(text, set).numerics.formulation;
  };
  EXPECT_EQ(formulation(smallest), total_lagrangian);
  EXPECT_EQ(formulation(smallest, {"specimen.depth=0.1 mm"}), total_lagrangian);
  EXPECT_EQ(formulation(smallest + "numerics: {plane: stress, mass_scaling: 0.7}\n"),
            total_lagrangian);
  EXPECT_EQ(formulation(smallest + "numerics: {formulation: updated_lagrangian}\n"),
            updated_lagrangian);
  for (const char* of_grid : {"shape_function=gimp", "domain=0.5", "scheme=apic", "pic_share=0.1",
                              "update_order=usl", "f_bar=false"})
    EXPECT_EQ(formulation(smallest, {std::string("numerics.") + of_grid}), updated_lagrangian)
        << of_grid;
  EXPECT_EQ(formulation("specimen: {micrograph: wood.png, pixel_size: 1 um}\n"
                        "free_motion: {end_time: 1 us}\n"),
            updated_lagrangian);
  EXPECT_EQ(formulation("specimen:\n  size: [1 mm, 1 mm]\n"
                        "  shapes: [{disc: {centre: [0.5 mm, 0.5 mm], radius: 0.4 mm}}]\n"
                        "loading: {speed: 1 m/s}\n"),
            updated_lagrangian);
}

TEST_F(SceneDefaults, WithoutMaterialTheWallIsNairns2006)
{
  const Scene scene = read(smallest);
  ASSERT_EQ(scene.materials.size(), 1u);
  const Material& wall = scene.materials[0];
  EXPECT_EQ(wall.law, "von_mises");
  EXPECT_EQ(wall.values.number("youngs_modulus"), 10.6e9);
  EXPECT_EQ(wall.values.number("poisson_ratio"), 0.33);
  EXPECT_EQ(wall.density(), 1500);
  EXPECT_EQ(wall.values.number("yield_stress"), 500e6);
}

TEST_F(SceneDefaults, SnapshotsAreSevenFromZeroToTheEnd)
{
  EXPECT_THAT(read(smallest).output.snapshot_strains, ElementsAre(0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6));
  EXPECT_THAT(read(smallest + "output: {snapshots: 3}\n").output.snapshot_strains,
              ElementsAre(0, 0.3, 0.6));
  EXPECT_THAT(read(smallest + "output: {snapshots: {count: 1}}\n").output.snapshot_strains,
              ElementsAre(0.6));
  const Output listed = read(smallest + "output: {snapshots: {times: [1 us]}}\n").output;
  EXPECT_THAT(listed.snapshot_times, ElementsAre(1e-6));
  EXPECT_TRUE(listed.snapshot_strains.empty());
}

TEST_F(SceneDefaults, OneValueStandsForAllSidesOfThePlane)
{
  const Scene scene = read(smallest + "  lateral: free\ngrid: {margin: 0.1 mm, spacing: 5 um}\n");
  EXPECT_THAT(std::get<Loading>(scene.motion).lateral,
              ElementsAre("free", "free", "rigid", "rigid"));
  EXPECT_THAT(scene.grid.margin, ElementsAre(1e-4, 1e-4, 1e-4, 1e-4, 0, 0));
  EXPECT_THAT(*scene.grid.spacing, ElementsAre(5e-6, 5e-6, 0));
}

TEST_F(SceneDefaults, ThresholdTakesFourForms)
{
  const auto image = [&](const std::string& lines) {
    return *read("specimen:\n  micrograph: wood.png\n" + lines + "loading: {speed: 1 m/s}\n")
                .specimen.micrograph;
  };
  EXPECT_EQ(image("  threshold: 90\n").threshold, 90);
  EXPECT_EQ(image("  threshold: otsu\n").threshold_rule, ThresholdRule::otsu);
  for (const char* aimed :
       {"  threshold: {target_relative_density: 40 %}\n", "  target_relative_density: 0.4\n"}) {
    EXPECT_EQ(image(aimed).threshold_rule, ThresholdRule::target_relative_density);
    EXPECT_EQ(image(aimed).target_relative_density, 0.4);
  }
  const Micrograph weighed = image("  threshold: {target_density: 0.45 g/cm^3}\n");
  EXPECT_EQ(weighed.threshold_rule, ThresholdRule::target_density);
  EXPECT_DOUBLE_EQ(weighed.target_density, 450);
  EXPECT_TRUE(image("  flip: both\n").flip_vertical);
  EXPECT_EQ(image("  rotate: 270\n").rotate, 270);
}

TEST_F(SceneDefaults, AnEmptyLoadCellIsTheDefaultOne)
{
  EXPECT_EQ(std::get<Loading>(read(smallest + "  load_cell:\n").motion).load_cell, LoadCell{});
  EXPECT_EQ(std::get<Loading>(read(smallest).motion).load_cell, std::nullopt);
}

/// That `write` writes what stands in this file of docs, as `option` of the program does.
void expect_in_docs(void (*write)(std::ostream&), const std::string& name,
                    const std::string& option)
{
  std::ostringstream written, shipped;
  write(written);
  shipped << std::ifstream(MPM_DOCS_DIR "/" + name).rdbuf();
  EXPECT_TRUE(shipped.str() == written.str()) << "Run: mpm_par " << option << " > docs/" << name;
}

TEST(InputReference, PageInDocsIsTheOneTheProgramWrites)
{
  expect_in_docs(write_input_reference, "input_reference.md", "--input-reference");
}

TEST(InputSchema, FileInDocsIsTheOneTheProgramWrites)
{
  expect_in_docs(write_input_schema, "scene.schema.json", "--input-schema");
}

}  // namespace
}  // namespace mpm::scene
