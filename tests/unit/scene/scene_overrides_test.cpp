#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;

using Overrides = SceneFolder;

const std::string wall =
    "{name: wall, density: 1 g/cm^3, youngs_modulus: 1 GPa, poisson_ratio: 0.3, yield_stress: 1 "
    "MPa}\n";

TEST_F(Overrides, ChangeAndCreateKeys)
{
  const Scene scene = read(smallest, {"loading.speed=5 m/s", "grid.cells=[30, 20]", "title=b = c"});
  EXPECT_EQ(std::get<Loading>(scene.motion).speed, 5);
  EXPECT_THAT(*scene.grid.cells, ElementsAre(30, 20, 0));
  EXPECT_EQ(scene.title, "b = c");
}

TEST_F(Overrides, ReachListEntriesAndASingleMaterialByEitherName)
{
  for (const std::string& materials : {"material: " + wall, "materials:\n  - " + wall}) {
    for (const char* path : {"material.density", "materials[0].density"}) {
      const Scene scene = read(smallest + materials, {std::string(path) + "=700 kg/m^3"});
      EXPECT_EQ(scene.materials.at(0).density(), 700) << materials << path;
    }
  }
}

TEST_F(Overrides, TheLastOfTwoCounts)
{
  EXPECT_EQ(*read(smallest, {"steps=3", "steps=4"}).steps, 4);
}

TEST_F(Overrides, AreNamedInErrorsAfterThoseOfTheFile)
{
  EXPECT_THAT(problems(smallest + "stepps: 3\n", {"loading.speed=fast", "loading.foo=1"}),
              ElementsAre("a.yaml:7:1: unknown key 'stepps' (did you mean 'steps'?)",
                          "--set loading.foo=1: unknown key 'foo' (known: piston, speed, strain, "
                          "ramp_time, grip, friction, lateral, load_cell)",
                          "--set loading.speed=fast: loading.speed is 'fast' (must be a velocity). "
                          "Write e.g. 10 m/s."));
}

TEST_F(Overrides, AreNamedWhereTheMapThatTheyMakeLacksAKey)
{
  EXPECT_THAT(problems(smallest, {"free_motion.sides=free"}),
              testing::Contains(testing::StartsWith(
                  "--set free_motion.sides=free: free_motion.end_time is missing")));
}

TEST_F(Overrides, ThatAreNoAssignment)
{
  const std::string remedy =
      ": is no assignment. Write --set path.to.key=value, e.g. --set loading.speed='10 m/s'.";
  EXPECT_THAT(problems(smallest, {"loading.speed", "=3", "a..b=3", "a[x]=3"}),
              ElementsAre("--set loading.speed" + remedy, "--set =3" + remedy,
                          "--set a..b=3" + remedy, "--set a[x]=3" + remedy));
}

TEST_F(Overrides, ThatLeadNowhere)
{
  EXPECT_THAT(
      problems(smallest, {"materials[1].density=1 g/cm^3", "loading.speed.x=3"}),
      ElementsAre(
          "--set materials[1].density=1 g/cm^3: there is no materials[1] (materials "
          "has 0 entries). Count them from 0.",
          "--set loading.speed.x=3: loading.speed is 10 m/s (has no key 'x'). Set loading.speed "
          "as a whole."));
}

}  // namespace
}  // namespace mpm::scene
