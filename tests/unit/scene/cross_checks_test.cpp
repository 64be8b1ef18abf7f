#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

using CrossChecks = SceneFolder;

const std::string motion = "free_motion: {end_time: 1 us}\n";

TEST_F(CrossChecks, AMissingPicture)
{
  EXPECT_THAT(problems("specimen: {micrograph: oak.png}\n" + motion),
              ElementsAre("a.yaml:1:24: specimen.micrograph is 'oak.png' (no such file: oak.png). "
                          "Give the path from the scene's folder."));
}

TEST_F(CrossChecks, KeysThatExcludeEachOther)
{
  EXPECT_THAT(
      problems(smallest + "  strain: 0.5\n" + motion + "grid:\n  cells: [9, 9]\n  spacing: 1 um\n"),
      ElementsAre("a.yaml:8:1: free_motion does not go with loading (given at "
                  "a.yaml:4:1). Keep one of them.",
                  "a.yaml:11:12: grid.spacing does not go with grid.cells (given at "
                  "a.yaml:10:10). Keep one of them."));
  EXPECT_THAT(
      problems("specimen: {micrograph: wood.png, pixel_size: 1 um, image_size: [1 mm, 1 mm],\n"
               "  threshold: 9, target_relative_density: 0.3}\n" +
               motion),
      ElementsAre("a.yaml:1:46: specimen.pixel_size does not go with specimen.image_size (given at "
                  "a.yaml:1:64). Keep one of them.",
                  "a.yaml:2:42: specimen.target_relative_density does not go with "
                  "specimen.threshold (given at a.yaml:2:14). Keep one of them."));
}

TEST_F(CrossChecks, ShapesBesideAPicture)
{
  EXPECT_THAT(problems("specimen:\n  micrograph: wood.png\n  shapes: []\n" + motion),
              ElementsAre("a.yaml:3:3: specimen.shapes is [] (belongs to a specimen without a "
                          "micrograph only). Remove it."));
}

TEST_F(CrossChecks, ASpecimenOfNothing)
{
  EXPECT_THAT(problems("specimen: {}\n" + motion),
              ElementsAre("a.yaml:1:1: specimen.micrograph is missing (what the specimen looks "
                          "like). Add micrograph: FILE, or size: [WIDTH, HEIGHT] and shapes."));
}

TEST_F(CrossChecks, ImpossibleShapes)
{
  EXPECT_THAT(problems(R"(specimen:
  shapes:
    - box: {lower: [1 mm, 0 mm], upper: [0 mm, 1 mm]}
    - polygon: {vertices: [[0 m, 0 m], [1 m, 0 m]]}
    - honeycomb: {lower: [0 m, 0 m], upper: [1 m, 1 m], cell_side: 1 um, wall_thickness: 2 um}
    - material: cell_wal
)" + motion),
              ElementsAre("a.yaml:1:1: specimen.size is missing (shapes lie in a rectangle of this "
                          "size, or in a cuboid). Add e.g. size: [1 mm, 1 mm].",
                          "a.yaml:3:41: specimen.shapes[0].box.upper is [0 mm, 1 mm] (must be "
                          "above lower along x).",
                          "a.yaml:4:27: specimen.shapes[1].polygon.vertices is [[0 m, 0 m], [1 m, "
                          "0 m]] (a polygon has at least 3 vertices).",
                          "a.yaml:5:90: specimen.shapes[2].honeycomb.wall_thickness is 2 um (must "
                          "be below sqrt(3) cell_side, or no lumen is left).",
                          "a.yaml:6:7: specimen.shapes[3].box is missing (what the shape is). Add "
                          "box, disc, polygon or honeycomb.",
                          "a.yaml:6:17: specimen.shapes[3].material is 'cell_wal' (no such "
                          "material; did you mean 'cell_wall'?)."));
}

TEST_F(CrossChecks, BandsCropAndWindows)
{
  EXPECT_THAT(problems(R"(specimen:
  micrograph: wood.png
  crop: [0, 0, 0, 5]
  bands:
    - {from: 100, to: 50, material: cell_wall}
    - {from: 0, to: 60, material: ray}
    - {from: 50, to: 256, material: cell_wall}
  windows:
    - {name: early, x: [0.5, 0.2]}
    - {name: early}
)" + motion),
              ElementsAre("a.yaml:3:16: specimen.crop[2] is 0 (the width must be at least 1 "
                          "pixel).",
                          "a.yaml:5:14: specimen.bands[0].from is 100 (must be below to, 50).",
                          "a.yaml:6:35: specimen.bands[1].material is 'ray' (no such material; "
                          "known: cell_wall).",
                          "a.yaml:7:14: specimen.bands[2].from is 50 (overlaps bands[1] from 0 to "
                          "60).",
                          "a.yaml:9:24: specimen.windows[0].x is [0.5, 0.2] (the first must be "
                          "below the second).",
                          "a.yaml:10:14: specimen.windows[1].name is 'early' (windows[0] has this "
                          "name already). Choose another name."));
}

TEST_F(CrossChecks, MaterialsAreToldApartByNameAndOneDeforms)
{
  EXPECT_THAT(problems(smallest + "materials:\n  - {law: rigid, name: a}\n"
                                  "  - {law: rigid, name: a}\n  - {law: rigid}\n"),
              ElementsAre("a.yaml:8:11: materials[0].law is 'rigid' (no material is left that can "
                          "be deformed). Add one of another law.",
                          "a.yaml:9:24: materials[1].name is 'a' (materials[0] has this name "
                          "already). Choose another name.",
                          "a.yaml:10:5: materials[2].name is missing (several materials are told "
                          "apart by name). Add e.g. name: cell_wall."));
}

TEST_F(CrossChecks, ElasticEnergyOfATransverselyIsotropicLawIsPositive)
{
  // E_A = E_T and nu_T = 0: nu_A^2 < 1/2.
  const std::string material =
      "material: {law: transversely_isotropic, density: 1 g/cm^3, youngs_modulus: 1 GPa,\n"
      "  poisson_ratio: 0, axial_modulus: 1 GPa, axial_shear_modulus: 1 GPa,\n"
      "  axial_poisson_ratio: ";
  EXPECT_THAT(problems(smallest + material + "0.71}\n"),
              ElementsAre("a.yaml:9:24: material.axial_poisson_ratio is 0.71 (must lie within "
                          "+-0.7071, the square root of axial_modulus (1 - poisson_ratio) / (2 "
                          "youngs_modulus), or stretching would release energy)."));
  EXPECT_TRUE(problems(smallest + material + "0.70}\n").empty());
}

TEST_F(CrossChecks, ALoadCellOfAMaterialThatNoIsotropicSolidIsLike)
{
  EXPECT_THAT(problems("material: {law: transversely_isotropic, youngs_modulus: 1 GPa, "
                       "poisson_ratio: 0.6, axial_modulus: 10 GPa, axial_poisson_ratio: 0.1, "
                       "axial_shear_modulus: 1 GPa, density: 1 g/cm^3}\n" +
                       smallest + "  load_cell: {cells: 3}\n"),
              Contains(HasSubstr("which has less than 0.5")));
}

TEST_F(CrossChecks, StressLastWithLinearShapeFunctions)
{
  const std::string usl = "numerics: {update_order: usl, shape_function: ";
  EXPECT_THAT(
      problems(smallest + usl + "linear}\n"),
      ElementsAre("a.yaml:7:26: numerics.update_order is 'usl' (with linear shape functions "
                  "no time step is stable at free edges). Use update_order: musl."));
  EXPECT_TRUE(problems(smallest + usl + "gimp}\n").empty());
}

TEST_F(CrossChecks, FBarInPlaneStress)
{
  EXPECT_THAT(problems(smallest + "numerics: {plane: stress, f_bar: true}\n"),
              ElementsAre("a.yaml:7:34: numerics.f_bar is 'true' (in plane stress the thickness "
                          "follows, and nothing locks). Leave it out."));
  EXPECT_TRUE(problems(smallest + "numerics: {f_bar: true}\n").empty());
}

TEST_F(CrossChecks, RefinedVelocitiesWithStressLast)
{
  const std::string usl = "numerics: {update_order: usl, scheme: ";
  EXPECT_THAT(problems(smallest + usl + "fmpm}\n"),
              ElementsAre("a.yaml:7:26: numerics.update_order is 'usl' (with fmpm the stable step "
                          "falls with every refinement of the velocity that the stress sees). Use "
                          "update_order: musl."));
  EXPECT_THAT(problems(smallest + "numerics: {scheme: fmpm, refinement_order: 9}\n"),
              ElementsAre("a.yaml:7:44: numerics.refinement_order is 9 (must be at most 8)."));
  EXPECT_EQ(problems(smallest + "numerics: {scheme: flip, refinement_order: 3}\n").size(), 1u);
}

TEST_F(CrossChecks, DomainsLargerThanACellAndOfShapeFunctionsWithoutAny)
{
  EXPECT_THAT(problems(smallest + "numerics: {domain: 2.5}\n"),
              ElementsAre("a.yaml:7:20: numerics.domain is 2.5 (domains would be larger than a "
                          "cell). Set at most 2, as many as grid.particles_per_cell."));
  EXPECT_TRUE(problems(smallest + "numerics: {domain: 2}\n").empty());
  EXPECT_EQ(problems(smallest + "numerics: {shape_function: linear, domain: 1}\n").size(), 1u);
}

TEST_F(CrossChecks, SharesOfPicInSchemesThatTakeTheGridVelocity)
{
  EXPECT_TRUE(problems(smallest + "numerics: {pic_share: 0.01}\n").empty());
  EXPECT_EQ(problems(smallest + "numerics: {scheme: apic, pic_share: 0.01}\n").size(), 1u);
}

TEST_F(CrossChecks, AffineSchemesWithLinearShapeFunctions)
{
  const std::string linear = "numerics: {shape_function: linear, scheme: ";
  EXPECT_THAT(
      problems(smallest + linear + "tpic}\n"),
      ElementsAre("a.yaml:7:44: numerics.scheme is 'tpic' (with linear shape functions no time "
                  "step is stable at free edges). Use scheme: flip, or shape_function: gimp, "
                  "quadratic, cubic or cpdi."));
  EXPECT_EQ(problems(smallest + linear + "apic}\n").size(), 1u);
  EXPECT_TRUE(problems(smallest + linear + "pic}\n").empty());
}

TEST_F(CrossChecks, SnapshotsBeyondTheEnd)
{
  EXPECT_THAT(problems(smallest + "  strain: 0.3\noutput: {snapshots: {strains: [0.1, 0.4]}}\n"),
              ElementsAre("a.yaml:8:37: output.snapshots.strains[1] is 0.4 (the run ends at "
                          "loading.strain 0.3). Lower it or raise loading.strain."));
  EXPECT_THAT(problems("specimen: {micrograph: wood.png}\n" + motion +
                       "output: {snapshots: {strains: [0.1], times: [2 us]}}\n"),
              ElementsAre("a.yaml:3:31: output.snapshots.strains is [0.1] (free motion has no "
                          "strain). Use times.",
                          "a.yaml:3:46: output.snapshots.times[0] is 2 us (the run ends at "
                          "free_motion.end_time 1 us). Lower it or raise free_motion.end_time."));
}

TEST_F(CrossChecks, FieldsTwiceAndNamesThatAreNoFolder)
{
  EXPECT_THAT(problems(smallest + "output: {fields: [stress, stress]}\nname: a/b\n"),
              ElementsAre("a.yaml:7:27: output.fields[1] is 'stress' (it is in the list already). "
                          "Remove one.",
                          "a.yaml:8:7: name is 'a/b' (it names a folder). Use letters, digits, - "
                          "and _."));
}

}  // namespace
}  // namespace mpm::scene
