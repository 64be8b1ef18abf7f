#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using InputErrors = SceneFolder;

TEST_F(InputErrors, UnknownKeys)
{
  EXPECT_THAT(problems(smallest + "  sped: 1 m/s\nstepps: 3\ncolour: 2\n"),
              ElementsAre("a.yaml:7:3: unknown key 'sped' (did you mean 'speed'?)",
                          "a.yaml:8:1: unknown key 'stepps' (did you mean 'steps'?)",
                          "a.yaml:9:1: unknown key 'colour' (known: title, name, material, "
                          "materials, specimen, grid, numerics, loading, free_motion, definitions, "
                          "loads, contact, exact_solution, steps, output)"));
}

TEST_F(InputErrors, AMisspeltRequiredKeyIsNotReportedAsMissingToo)
{
  EXPECT_THAT(problems("specimen: {micrograf: wood.png, pixel_size: 1 um}\nloading: {sped: 1 m/s}"),
              ElementsAre("a.yaml:1:12: unknown key 'micrograf' (did you mean 'micrograph'?)",
                          "a.yaml:2:11: unknown key 'sped' (did you mean 'speed'?)"));
}

TEST_F(InputErrors, KeysGivenTwice)
{
  EXPECT_THAT(problems(smallest + "  speed: 3 m/s\n"),
              ElementsAre("a.yaml:7:3: loading.speed is given twice (first at a.yaml:6:3). "
                          "Remove one."));
}

TEST_F(InputErrors, MissingKeys)
{
  EXPECT_THAT(problems("title: nothing\n"),
              ElementsAre("a.yaml:1:1: specimen is missing (what is crushed). Add it as a map "
                          "of keys.",
                          "a.yaml:1:1: loading is missing (what moves the specimen). Add loading: "
                          "{piston: right, speed: 10 m/s}, or free_motion: {end_time: 1 ms}."));
  EXPECT_THAT(problems("specimen: {micrograph: wood.png}\nloading:\n  piston: left\n"),
              ElementsAre("a.yaml:2:1: loading.speed is missing (of the piston). Add it: a "
                          "velocity, e.g. 10 m/s; above 0."));
}

TEST_F(InputErrors, Units)
{
  EXPECT_THAT(problems(smallest + R"(material:
  density: 1500
  youngs_modulus: 7 MPA
  poisson_ratio: 0.3 m
  yield_stress: 10 mm
)"),
              ElementsAre("a.yaml:8:12: material.density is 1500 (a density needs a unit). Write "
                          "e.g. 1500 kg/m^3.",
                          "a.yaml:9:19: material.youngs_modulus is 7 MPA (unknown unit 'MPA', did "
                          "you mean 'MPa'?). Write e.g. 10.6 GPa.",
                          "a.yaml:10:18: material.poisson_ratio is 0.3 m (takes no unit). Write "
                          "e.g. 0.3.",
                          "a.yaml:11:17: material.yield_stress is 10 mm (mm is a length, not a "
                          "pressure). Write e.g. 10.6 GPa."));
}

TEST_F(InputErrors, Ranges)
{
  EXPECT_THAT(problems(smallest + "  strain: 120 %\n  ramp_time: -1 us\n"
                                  "grid: {cells: [1, 20], particles_per_cell: 9}\n"),
              ElementsAre("a.yaml:7:11: loading.strain is 120 % (must be below 0.99).",
                          "a.yaml:8:14: loading.ramp_time is -1 us (must be at least 0).",
                          "a.yaml:9:16: grid.cells[0] is 1 (must be at least 2).",
                          "a.yaml:9:44: grid.particles_per_cell is 9 (must be at most 8)."));
}

TEST_F(InputErrors, PoissonRatioOfOneHalf)
{
  EXPECT_THAT(problems(smallest + "material: {law: isotropic, density: 1 g/cm^3, youngs_modulus: 1 "
                                  "GPa,\n  poisson_ratio: 0.5}\n"),
              ElementsAre("a.yaml:8:18: material.poisson_ratio is 0.5 (must be below 0.5)."));
}

TEST_F(InputErrors, WrongTypes)
{
  EXPECT_THAT(problems(smallest + R"(grid: 150
steps: 2.5
numerics: {scheme: flipp, cfl: fast, ranks: 4}
output:
  compress: maybe
  fields: stress
title: [a]
name:
)"),
              ElementsAre("a.yaml:7:7: grid is 150 (must be a map with keys such as cells: ...).",
                          "a.yaml:8:8: steps is 2.5 (must be a whole number).",
                          "a.yaml:9:20: numerics.scheme is 'flipp' (must be flip, pic, apic, tpic, "
                          "fmpm or xpic; did you mean 'flip'?).",
                          "a.yaml:9:32: numerics.cfl is 'fast' (must be a number). Write e.g. 1.",
                          "a.yaml:9:45: numerics.ranks is 4 (must be a list of 2).",
                          "a.yaml:11:13: output.compress is 'maybe' (must be true or false).",
                          "a.yaml:12:11: output.fields is 'stress' (must be a list).",
                          "a.yaml:13:8: title is ['a'] (must be a text).",
                          "a.yaml:14:1: name is empty (must be a text)."));
}

TEST_F(InputErrors, KeysOfAnotherLaw)
{
  EXPECT_THAT(problems(smallest + R"(material:
  law: isotropic
  density: 1500 kg/m^3
  youngs_modulus: 1 GPa
  poisson_ratio: 0.3
  yield_stress: 5 MPa
  axial_modulus: 3 GPa
)"),
              ElementsAre("a.yaml:12:3: material.yield_stress is 5 MPa (belongs to law von_mises "
                          "only). Remove it.",
                          "a.yaml:13:3: material.axial_modulus is 3 GPa (belongs to law "
                          "transversely_isotropic only). Remove it."));
}

TEST_F(InputErrors, AMisspeltLawLeavesItsKeysAlone)
{
  EXPECT_THAT(problems(smallest + "material: {law: isotropc, axial_modulus: 3 GPa}\n"),
              ElementsAre("a.yaml:7:17: material.law is 'isotropc' (must be isotropic, "
                          "transversely_isotropic, neo_hookean, von_mises or rigid; did you mean "
                          "'isotropic'?)."));
}

TEST_F(InputErrors, AListEntryIsNamedByItsPosition)
{
  EXPECT_THAT(problems(smallest + R"(materials:
  - {name: wall, density: 0 kg/m^3, youngs_modulus: 1 GPa, poisson_ratio: 0, yield_stress: 1 MPa}
  - {name: ram, law: rigid, velocity: [1 m/s, 2]}
)"),
              ElementsAre("a.yaml:8:27: materials[0].density is 0 kg/m^3 (must be above 0).",
                          "a.yaml:9:47: materials[1].velocity[1] is 2 (a velocity needs a unit). "
                          "Write e.g. 10 m/s."));
}

TEST_F(InputErrors, AValueOverSeveralLinesIsShownOnOne)
{
  EXPECT_THAT(problems(smallest + "steps: |\n  many\n  more " + std::string(80, 'x') + "\n"),
              ElementsAre(std::string("a.yaml:7:8: steps is 'many more ")
                              .append(50, 'x')
                              .append("...' (must be a number). Write e.g. 10.")));
}

TEST_F(InputErrors, ASoundSceneHasNone)
{
  EXPECT_THAT(problems(smallest), IsEmpty());
}

}  // namespace
}  // namespace mpm::scene
