// Loads, formulas, tables of velocities and moving sides: what is read, and what is refused.
#include <sstream>

#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string square = R"yaml(specimen:
  size: [1 mm, 1 mm]
  shapes: [{box: {lower: [0 m, 0 m], upper: [1 mm, 1 mm]}}]
)yaml";
const std::string free_for_1_ms = "free_motion: {end_time: 1 ms}\n";

class LoadsInScenes : public SceneFolder {};

TEST_F(LoadsInScenes, OfEveryKindAreReadInSIUnitsWithTheirDefaults)
{
  const Scene scene = read(square + free_for_1_ms + R"yaml(loads:
  - {kind: gravity, acceleration: [0 m/s^2, -9.81 m/s^2]}
  - {kind: body_force, acceleration: ["sin(pi*x)*t", 2 mm/s^2], ramp_time: 3 us}
  - {kind: traction, side: top, stress: [0 Pa, -2 MPa], within: {lower: [0 m, 0 m], upper: [1 mm, 2 mm]}}
  - {kind: damping, rate: 2 1/ms}
)yaml");
  ASSERT_EQ(scene.loads.size(), 4u);
  EXPECT_THAT(scene.loads[0].values.vector("acceleration"), ElementsAre(0, -9.81, 0));
  EXPECT_EQ(scene.loads[0].values.number("ramp_time"), 0);
  const Formulas& formulas = scene.loads[1].values.formulas("acceleration");
  EXPECT_EQ(formulas[0].text(), "sin(pi*x)*t");
  EXPECT_EQ(formulas[1](std::array<double, 2>{}, 0), 2e-3);
  EXPECT_EQ(scene.loads[1].values.number("ramp_time"), 3e-6);
  EXPECT_EQ(scene.loads[2].values.word("side"), "top");
  EXPECT_THAT(scene.loads[2].values.corners("within").upper, ElementsAre(1e-3, 2e-3, 0));
  EXPECT_EQ(scene.loads[3].values.number("rate"), 2000);
}

TEST_F(LoadsInScenes, ReadBackTheSameFromTheEffectiveScene)
{
  const std::string text = R"yaml(materials:
  - {name: wall, law: isotropic, density: 1500 kg/m^3, youngs_modulus: 10.6 GPa, poisson_ratio: 0.3}
  - {name: ram, law: rigid, velocity_table: [[0 s, 0 m/s, 0 m/s], [1 us, 1 m/s, -2 m/s]]}
specimen:
  size: [1 mm, 1 mm]
  shapes:
    - {box: {lower: [0 m, 0 m], upper: [1 mm, 1 mm]}}
    - {box: {lower: [0 m, 0 m], upper: [0.1 mm, 1 mm]}, material: ram}
  initial_velocity: ["-3.25*x/(1+y)", 1.5 mm/s]
free_motion:
  end_time: 1 ms
  moving_sides:
    - {side: top, table: [[0 s, 0 m/s], [1 us, 3 m/s], [2 us, 0 m/s]]}
    - {side: left, grip: slip, table: [[0 s, 1 mm/s], [1 s, 1 mm/s]]}
loads:
  - {kind: body_force, acceleration: ["x > 0.5 ? sin(t) : -1", 0]}
  - {kind: traction, side: right, stress: [1 kPa, 0 Pa], within: {lower: [0 m, 0 m], upper: [1 m, 1 m]}}
  - {kind: traction, side: left, stress: [-1 kPa, 0 Pa]}
)yaml";
  const Scene original = read(text);
  std::ostringstream written;
  write_effective_scene(written, original);
  Scene again = read_scene(write("again.yaml", written.str()));
  again.file = original.file;
  EXPECT_TRUE(again == original) << written.str();
  const auto& table = original.materials[1].values.table("velocity_table").rows;
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[1].time, 1e-6);
  EXPECT_THAT(table[1].values, ElementsAre(1, -2, 0));
  const auto& sides = std::get<FreeMotion>(original.motion).moving_sides;
  EXPECT_EQ(sides[0].grip, Grip::stick);
  EXPECT_THAT(sides[0].table, ElementsAre(WallMotion::Entry{0, 0}, WallMotion::Entry{1e-6, 3},
                                          WallMotion::Entry{2e-6, 0}));
}

TEST_F(LoadsInScenes, WrongOnesAreRefusedWithPlaceReasonAndRemedy)
{
  EXPECT_THAT(
      problems(square + free_for_1_ms + R"yaml(loads:
  - {kind: gravty, acceleration: [0 m/s^2, 0 m/s^2]}
  - {acceleration: [0 m/s^2, 0 m/s^2]}
  - {kind: gravity, rate: 1 1/s}
  - {kind: body_force, acceleration: ["sin(z)", "2*(x"]}
  - {kind: body_force, acceleration: [1 mm, 0]}
  - {kind: traction, stress: [1 Pa, 0 Pa]}
  - {kind: traction, side: front, stress: [1 Pa, 0 Pa]}
  - {kind: traction, side: left, stress: [1 Pa, 0 Pa], within: {lower: [0 m, 1 m], upper: [1 m, 0 m]}}
  - {kind: damping, rate: -1 1/s}
)yaml"),
      ElementsAre(
          HasSubstr("a.yaml:6:12: loads[0].kind is 'gravty' (must be gravity, body_force, traction "
                    "or damping; did you mean 'gravity'?)"),
          HasSubstr("a.yaml:7:5: loads[1].kind is missing"),
          HasSubstr("a.yaml:8:5: loads[2].acceleration is missing"),
          HasSubstr("a.yaml:8:21: loads[2].rate is 1 1/s (belongs to kind damping only)"),
          HasSubstr("a.yaml:9:39: loads[3].acceleration[0] is 'sin(z)' (is no formula: Unexpected "
                    "token \"z\" found at position 4). Use numbers, x, y, t"),
          HasSubstr("a.yaml:9:49: loads[3].acceleration[1] is '2*(x' (is no formula: Missing "),
          HasSubstr("a.yaml:10:39: loads[4].acceleration[0] is 1 mm (mm is a length, not an "
                    "acceleration). Write e.g. 9.81 m/s^2."),
          HasSubstr("a.yaml:11:5: loads[5].side is missing"),
          HasSubstr("a.yaml:12:28: loads[6].side is 'front' (the scene lies in the plane)"),
          HasSubstr("loads[7].within is a map (upper must be above lower along y)"),
          HasSubstr("a.yaml:14:27: loads[8].rate is -1 1/s (must be at least 0)")));
}

TEST_F(LoadsInScenes, AnInitialVelocityDoesNotGoWithThatOfAShape)
{
  EXPECT_THAT(problems(R"yaml(specimen:
  size: [1 mm, 1 mm]
  initial_velocity: [x, y]
  shapes: [{box: {lower: [0 m, 0 m], upper: [1 mm, 1 mm]}, velocity: [1 m/s, 0 m/s]}]
)yaml" + free_for_1_ms),
              ElementsAre(HasSubstr("specimen.shapes[0].velocity does not go with "
                                    "specimen.initial_velocity (given at a.yaml:3:")));
}

TEST_F(LoadsInScenes, TablesNeedTwoEntriesAtLeastAndAscendingTimes)
{
  const std::string motion = "free_motion: {end_time: 1 ms, moving_sides: [{side: left, table: ";
  EXPECT_THAT(problems(square + motion + "[[0 s, 1 m/s]]}]}\n"),
              ElementsAre(HasSubstr("moving_sides[0].table is [[0 s, 1 m/s]] (must be a list of at "
                                    "least two entries)")));
  EXPECT_THAT(problems(square + motion + "[[1 s, 1 m/s], [1 s, 2 m/s]]}]}\n"),
              ElementsAre(HasSubstr("table[1][0] is 1 s (must be later than the entry before)")));
  EXPECT_THAT(problems(square + motion + "[[0 s, 1 m/s], [1 s, 2 m/s, 3 m/s]]}]}\n"),
              ElementsAre(HasSubstr("table[1] is [1 s, 2 m/s, 3 m/s] (must be a list of 2: a time "
                                    "and a value)")));
}

TEST_F(LoadsInScenes, ASideMovesOnceAndIsFreeOtherwise)
{
  const std::string table = "table: [[0 s, 0 m/s], [1 s, 0 m/s]]";
  EXPECT_THAT(
      problems(square +
               "free_motion: {end_time: 1 ms, sides: [rigid, free, free, free], "
               "moving_sides: [{side: left, " +
               table + "}, {side: top, " + table + "}, {side: top, " + table + "}, {side: back, " +
               table + "}]}\n"),
      ElementsAre(HasSubstr("moving_sides[0].side is 'left' (free_motion.sides makes it "
                            "rigid). Make it free there"),
                  HasSubstr("moving_sides[2].side is 'top' (moving_sides[1] is the same "
                            "side). Remove one"),
                  HasSubstr("moving_sides[3].side is 'back' (the scene lies in the plane)")));
}

TEST_F(LoadsInScenes, ARigidMaterialHasAVelocityOrATable)
{
  const std::string materials = R"yaml(materials:
  - {name: wall, density: 1 g/cm^3, youngs_modulus: 1 GPa, poisson_ratio: 0, yield_stress: 1 GPa}
  - {name: ram, law: rigid, velocity: [1 m/s, 0 m/s], velocity_table: [[0 s, 0 m/s, 0 m/s], [1 s, 0 m/s, 0 m/s]]}
)yaml";
  EXPECT_THAT(problems(square + free_for_1_ms + materials),
              ElementsAre(HasSubstr("materials[1].velocity_table is [[0 s, 0 m/s, 0 m/s], [1 s, "
                                    "0 m/s, 0 m/s]] (does not go with velocity)")));
}

}  // namespace
}  // namespace mpm::scene
