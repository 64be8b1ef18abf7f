// Definitions that formulas use, and the exact solution: what is read, and what is refused.
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
free_motion: {end_time: 1 ms}
)yaml";

class ExactSolutionInScenes : public SceneFolder {};

TEST_F(ExactSolutionInScenes, IsReadInTermsOfDefinitionsWhereverTheyStand)
{
  const Scene scene = read(square + R"yaml(exact_solution:
  displacement: [A*sin(X), 0]
  stress_xy: 2 MPa
loads:
  - {kind: body_force, acceleration: [twice, x]}
definitions: {A: 0.5, twice: 2*A*Y}
)yaml");
  ASSERT_TRUE(scene.exact_solution && scene.exact_solution->displacement);
  const std::array place{7.0, 8.0}, start{0.25, 3.0};
  EXPECT_EQ((*scene.exact_solution->displacement)[0](place, start, 0), 0.5 * std::sin(0.25));
  EXPECT_EQ((*scene.exact_solution->stress_xy)(place, start, 0), 2e6);
  EXPECT_FALSE(scene.exact_solution->velocity || scene.exact_solution->stress_xx);
  const Formulas& force = scene.loads[0].values.formulas("acceleration");
  EXPECT_EQ(force[0](place, start, 0), 3);
  EXPECT_EQ(force[1](place, start, 0), 7);
}

TEST_F(ExactSolutionInScenes, ReadsBackTheSameFromTheEffectiveScene)
{
  const Scene original = read(square + R"yaml(definitions: {c: sqrt(2e9/1500), w: c*pi, s: sin(w*t)}
exact_solution: {velocity: [s*X, "-s*Y"], stress_zz: "c^2*t"}
)yaml");
  std::ostringstream written;
  write_effective_scene(written, original);
  Scene again = read_scene(write("again.yaml", written.str()));
  again.file = original.file;
  EXPECT_TRUE(again == original) << written.str();
  EXPECT_EQ(again.definitions.size(), 3u);
  EXPECT_EQ(again.definitions[2].text, "sin(w*t)");
}

TEST_F(ExactSolutionInScenes, WrongDefinitionsAreRefusedOnceAndWithPlace)
{
  EXPECT_THAT(problems(square + R"yaml(definitions:
  t: 3
  a: 2*later
  later: 1
  later: 2
  b: sin(
)yaml"),
              ElementsAre(HasSubstr("a.yaml:6:6: definitions.t is 3 (is a name that formulas have "
                                    "already). Use another name"),
                          HasSubstr("a.yaml:7:6: definitions.a is 2*later (is no formula: "
                                    "Unexpected token \"later\""),
                          HasSubstr("a.yaml:9:10: definitions.later is 2 (is a name that formulas "
                                    "have already)"),
                          HasSubstr("definitions.b is 'sin(' (is no formula:")));
  EXPECT_THAT(
      problems(square + "definitions: [a, b]\n"),
      ElementsAre(HasSubstr("definitions is ['a', 'b'] (must be a map of names to formulas)")));
}

TEST_F(ExactSolutionInScenes, AFormulaSaysWhichNamesThereAre)
{
  EXPECT_THAT(problems(square + R"yaml(definitions: {E: 1, rho: 2}
exact_solution: {displacement: [nu*X, 0], stress_yz: 1 Pa}
)yaml"),
              ElementsAre(HasSubstr("exact_solution.displacement[0] is 'nu*X' (is no formula: "
                                    "Unexpected token \"nu\" found at position 0). Use numbers, x, "
                                    "y, t, pi, X, Y (the place at t = 0), E, rho, + - * /"),
                          HasSubstr("exact_solution.stress_yz is 1 Pa (belongs to scenes in space "
                                    "only)")));
}

}  // namespace
}  // namespace mpm::scene
