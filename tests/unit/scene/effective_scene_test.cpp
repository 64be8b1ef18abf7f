#include <sstream>

#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using ::testing::ElementsAre;

class EffectiveScene : public SceneFolder {
 protected:
  void expect_round_trip(const std::string& text)
  {
    const Scene original = read(text);
    std::ostringstream written;
    write_effective_scene(written, original);
    // Elsewhere than the original, as in the folder of results.
    std::filesystem::create_directory(folder_ / "results");
    Scene again = read_scene(write("results/effective.yaml", written.str()));
    again.file = original.file;
    EXPECT_TRUE(again == original) << written.str();
  }
};

TEST_F(EffectiveScene, OfTheSmallestReadsBackTheSame)
{
  expect_round_trip(smallest);
}

TEST_F(EffectiveScene, OfCellsThatMayFailReadsBackTheSame)
{
  expect_round_trip(smallest + R"(numerics: {formulation: total_lagrangian}
material: {law: isotropic, density: 1 g/cm^3, youngs_modulus: 1 GPa, poisson_ratio: 0.3,
  failure: {stretch: 3.25}}
)");
}

TEST_F(EffectiveScene, OfADrawnMicrographReadsBackTheSame)
{
  write("wood.anatomy.yaml", "only its existence is checked here");
  expect_round_trip(R"(specimen:
  micrograph: wood.anatomy.yaml
  seed: 7
  threshold: {target_density: 0.45 g/cm^3}
loading: {piston: right, speed: 10 m/s}
)");
}

TEST_F(EffectiveScene, OfAMicrographWithEveryKeyReadsBackTheSame)
{
  expect_round_trip(R"(title: "all: of 'it' \"quoted\""
name: every_key
material: {law: von_mises, strain_measure: hypoelastic, density: 1.4999 g/cm^3,
  youngs_modulus: 10.61234567 GPa, poisson_ratio: 0.33, yield_stress: 431 MPa,
  hardening_modulus: 0.1 GPa}
specimen:
  micrograph: wood.png
  image_size: [0.832 mm, 0.541 mm]
  crop: [1, 2, 30, 40]
  rotate: 90
  flip: vertical
  wall: dark
  target_relative_density: 36.9 %
  remove_specks: 4
  remove_unconnected: true
  windows: [{name: earlywood, x: [0, 47.3 %]}]
grid: {spacing: [5.5 um, 7 um], particles_per_cell: 3, margin: [0 mm, 1 mm, 0.25 mm, 3 um]}
numerics: {plane: stress, thickness: 1 mm, shape_function: quadratic, scheme: apic,
  update_order: usl, cfl: 0.7, ranks: [2, 1]}
loading: {piston: top, speed: 36 km/h, strain: 0.7, ramp_time: 3 us, grip: slip,
  lateral: [symmetric, free], load_cell: {cells: 4, stiffness_ratio: 7}}
steps: 1e4
output: {history_lines: 77, snapshots: {strains: [10 %, 0.05], times: [1 us]},
  fields: [stress, id], compress: true}
)");
}

TEST_F(EffectiveScene, OfShapesAndSeveralMaterialsReadsBackTheSame)
{
  expect_round_trip(R"(materials:
  - {name: wall, law: isotropic, density: 1500 kg/m^3, youngs_modulus: 10.6 GPa, poisson_ratio: 0.3}
  - {name: ray, law: transversely_isotropic, density: 1450 kg/m^3, youngs_modulus: 1 GPa,
     poisson_ratio: 0.7, axial_modulus: 20 GPa, axial_poisson_ratio: 0.25,
     axial_shear_modulus: 800 MPa, unique_axis: in_plane, axis_angle: 37 deg}
  - {name: ram, law: rigid, velocity: [-1 m/s, 0.5 mm/s]}
specimen:
  size: [1 mm, 0.5 mm]
  shapes:
    - honeycomb: {lower: [0 m, 0 m], upper: [1 mm, 0.5 mm], cell_side: 30 um, wall_thickness: 4 um}
    - {disc: {centre: [0.2 mm, 0.2 mm], radius: 0.05 mm}, material: void}
    - {polygon: {vertices: [[0 m, 0 m], [0.1 mm, 0 m], [0 m, 0.1 mm]]}, material: ray,
       velocity: [1 m/s, -2 m/s]}
    - {box: {lower: [0 m, 0 m], upper: [1 um, 1 um]}, material: ram}
grid: {cells: [20, 10]}
free_motion: {end_time: 10 us, sides: [rigid, free, symmetric, free]}
output: {snapshots: 0, fields: []}
)");
}

TEST_F(EffectiveScene, SnapshotsOfWindowsHoldTheIdOfEachParticle)
{
  const auto fields = [&](const std::string& windows, const std::string& output) {
    return read("specimen: {micrograph: wood.png" + windows +
                "}\ngrid: {cells: [20, 10]}\nloading: {piston: right, speed: 10 m/s}\n" + output)
        .output.fields;
  };
  const std::string windows = ", windows: [{name: earlywood, x: [0, 47.3 %]}]";
  EXPECT_THAT(fields(windows, ""), ElementsAre(Field::von_mises, Field::plastic_work, Field::id));
  EXPECT_THAT(fields("", ""), ElementsAre(Field::von_mises, Field::plastic_work));
  EXPECT_THAT(fields(windows, "output: {fields: [stress]}"), ElementsAre(Field::stress));
  EXPECT_THAT(fields(windows, "output: {fields: [id, plastic_work]}"),
              ElementsAre(Field::id, Field::plastic_work));
}

TEST_F(EffectiveScene, OfGrayBandsAndOfOtsuReadsBackTheSame)
{
  expect_round_trip(R"(specimen:
  micrograph: wood.png
  bands: [{from: 50, to: 120.5, material: cell_wall}, {from: 120.5, to: 256, material: cell_wall}]
free_motion: {end_time: 1 us}
)");
  expect_round_trip(
      "specimen: {micrograph: wood.png, threshold: otsu}\n"
      "free_motion: {end_time: 1 us}\n");
}

TEST_F(EffectiveScene, OfShapesInSpaceReadsBackTheSame)
{
  expect_round_trip(R"(materials:
  - {name: wall, law: isotropic, density: 1500 kg/m^3, youngs_modulus: 10.6 GPa, poisson_ratio: 0.3}
  - {name: ram, law: rigid, velocity: [-1 m/s, 0.5 mm/s, 2 m/s]}
specimen:
  size: [1 mm, 0.5 mm, 0.3 mm]
  shapes:
    - tubes: {lower: [0 m, 0 m, 0 m], upper: [1 mm, 0.5 mm, 0.3 mm], cell_side: 30 um,
        wall_thickness: 4 um, axis: y}
    - {sphere: {centre: [0.2 mm, 0.2 mm, 0.1 mm], radius: 0.05 mm}, material: void}
    - {cylinder: {from: [0 m, 0 m, 0 m], to: [0.1 mm, 0 m, 0.1 mm], radius: 10 um,
        inner_radius: 3 um}, velocity: [1 m/s, -2 m/s, 3 m/s]}
    - {box: {lower: [0 m, 0 m, 0 m], upper: [1 um, 1 um, 2 um]}, material: ram}
  windows: [{name: back half, z: [0, 0.5]}]
grid: {cells: [20, 10, 6], margin: [1 um, 2 um, 0 um, 0 um, 0 um, 0 um]}
numerics: {ranks: [2, 1, 0]}
loading: {piston: front, speed: 1 m/s, lateral: [free, rigid, periodic, periodic]}
)");
}

TEST_F(EffectiveScene, OfAPictureDrawnOutIntoSpaceReadsBackTheSame)
{
  expect_round_trip(R"(specimen: {micrograph: wood.png, pixel_size: 1 um, depth: 0.25 mm}
grid: {spacing: 5 um}
free_motion: {end_time: 1 us, sides: [rigid, rigid, free, free, periodic, periodic]}
)");
}

TEST_F(EffectiveScene, NamesDefaultsInReadableUnits)
{
  std::ostringstream written;
  write_effective_scene(written, read(smallest + "numerics: {formulation: updated_lagrangian}\n"));
  for (const char* line : {"  youngs_modulus: 10.6 GPa\n", "  density: 1500 kg/m^3\n",
                           "  pixel_size: [2.3 um, 2.3 um]\n", "  shape_function: gimp\n",
                           "    strains: [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]\n"})
    EXPECT_THAT(written.str(), testing::HasSubstr(line));
}

TEST_F(EffectiveScene, NamesTheFormulationThatFollowsFromWhatIsCrushed)
{
  std::ostringstream written;
  write_effective_scene(written, read(smallest));
  EXPECT_THAT(written.str(), testing::HasSubstr("  formulation: total_lagrangian\n"));
}

}  // namespace
}  // namespace mpm::scene
