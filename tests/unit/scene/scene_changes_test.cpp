#include <mpm/core/error.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/scene/scene_changes.hpp>

#include <sstream>

#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string before = R"(name: a
specimen: {size: [1 mm, 2 mm], shapes: [{disc: {radius: 1 mm}}]}
loading: {strain: 30 %, speed: 5 m/s}
numerics: {cfl: 0.4}
)";

TEST(SceneChanges, NoneInTheSameSceneHoweverItIsWritten)
{
  EXPECT_THAT(changes_that_matter(before, before), IsEmpty());
  EXPECT_THAT(changes_that_matter("a: [1, 2]\n", "# title\na:\n  - 1\n  - 2\n"), IsEmpty());
}

TEST(SceneChanges, NamesEachValueThatDiffers)
{
  std::string now = before;
  now.replace(now.find("2 mm"), 4, "3 mm");
  now.replace(now.find("speed: 5"), 8, "speed: 6");
  EXPECT_THAT(
      changes_that_matter(before, now),
      ElementsAre("loading.speed was 5 m/s and is 6 m/s", "specimen.size[1] was 2 mm and is 3 mm"));
}

TEST(SceneChanges, NamesWhatIsNewAndWhatIsGone)
{
  EXPECT_THAT(changes_that_matter("a: 1\nb: 2\n", "a: 1\nc: {d: 3}\n"),
              ElementsAre("b was 2 and is not given", "c.d was not given and is 3"));
}

TEST(SceneChanges, TheEndTheOutputAndTheTimeStepMayChange)
{
  EXPECT_THAT(
      changes_that_matter("name: a\nloading: {strain: 30 %}\nnumerics: {cfl: 0.4}\nsteps: 30\n",
                          "name: b\nloading: {strain: 60 %}\nnumerics: {cfl: 0.2}\n"
                          "output: {history_lines: 9, fields: [stress]}\n"),
      IsEmpty());
}

TEST(SceneChanges, HowRanksAreArrangedAndWhereTheMicrographLiesMayChange)
{
  const std::string there = "specimen: {micrograph: /there/wood.bmp}\nnumerics: {ranks: [4, 2]}\n";
  EXPECT_THAT(changes_that_matter(there, "specimen: {micrograph: /here/wood.bmp}\n"), IsEmpty());
  EXPECT_THAT(changes_that_matter(there, "specimen: {micrograph: /there/poplar.bmp}\n"),
              ElementsAre("specimen.micrograph was /there/wood.bmp and is /there/poplar.bmp"));
}

}  // namespace
}  // namespace mpm::scene
