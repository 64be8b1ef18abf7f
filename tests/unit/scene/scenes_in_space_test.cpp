#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

class ScenesInSpace : public SceneFolder {
 protected:
  const std::string cuboid = R"(specimen:
  size: [1 mm, 2 mm, 3 mm]
  shapes: [{box: {lower: [0 m, 0 m, 0 m], upper: [1 mm, 2 mm, 3 mm]}}]
)";
  const std::string square = R"(specimen:
  size: [1 mm, 2 mm]
  shapes: [{box: {lower: [0 m, 0 m], upper: [1 mm, 2 mm]}}]
)";
  const std::string piston = "loading: {piston: right, speed: 1 m/s}\n";
};

TEST_F(ScenesInSpace, AreThoseWithThreeSizesOrAPictureWithADepth)
{
  EXPECT_EQ(read(square + piston).dimensions, 2);
  EXPECT_EQ(read(smallest).dimensions, 2);
  const Scene scene = read(cuboid + piston);
  EXPECT_EQ(scene.dimensions, 3);
  EXPECT_THAT(scene.specimen.size, ElementsAre(1e-3, 2e-3, 3e-3));
  const Scene drawn_out = read(smallest, {"specimen.depth=0.1 mm"});
  EXPECT_EQ(drawn_out.dimensions, 3);
  EXPECT_EQ(drawn_out.specimen.micrograph->depth, 1e-4);
}

TEST_F(ScenesInSpace, OneValueStandsForAllSides)
{
  const Scene scene = read(cuboid + "grid: {margin: 1 um, spacing: 5 um}\n" +
                           "loading: {piston: front, speed: 1 m/s, lateral: free}\n");
  EXPECT_THAT(scene.grid.margin, Each(1e-6));
  EXPECT_THAT(*scene.grid.spacing, Each(5e-6));
  EXPECT_THAT(std::get<Loading>(scene.motion).lateral, Each(Lateral("free")));
}

TEST_F(ScenesInSpace, ListsOfTheWrongLengthAreRefusedWithTheReason)
{
  EXPECT_THAT(problems(cuboid + "grid: {cells: [20, 10]}\n" + piston),
              ElementsAre("a.yaml:4:15: grid.cells is [20, 10] (must be a list of 3, as "
                          "specimen.size with three components, or specimen.depth, makes a scene "
                          "in space)."));
  EXPECT_THAT(problems(square + "numerics: {ranks: [1, 1, 2]}\n" + piston),
              ElementsAre("a.yaml:4:19: numerics.ranks is [1, 1, 2] (must be a list of 2, as the "
                          "scene lies in the plane: neither has specimen.size three components nor "
                          "is specimen.depth given)."));
  EXPECT_THAT(problems(cuboid + "numerics: {ranks: 4}\n" + piston),
              ElementsAre("a.yaml:4:19: numerics.ranks is 4 (must be a list of 3)."));
}

TEST_F(ScenesInSpace, KeysOfThePlaneAreRefusedAndTheOtherWayRound)
{
  EXPECT_THAT(problems(cuboid + "numerics: {plane: stress, thickness: 1 m}\n" + piston),
              ElementsAre("a.yaml:4:12: numerics.plane is 'stress' (belongs to scenes in the plane "
                          "only). Remove it.",
                          "a.yaml:4:27: numerics.thickness is 1 m (belongs to scenes in the plane "
                          "only). Remove it."));
  EXPECT_THAT(problems(square + "  windows: [{name: back, z: [0, 0.5]}]\n" + piston),
              ElementsAre("a.yaml:4:26: specimen.windows[0].z is [0, 0.5] (belongs to scenes in "
                          "space only). Remove it."));
}

TEST_F(ScenesInSpace, ShapesHaveTheirPlace)
{
  const std::string in_plane = R"(specimen:
  size: [1 mm, 2 mm]
  shapes:
    - sphere: {centre: [0 m, 0 m, 0 m], radius: 1 mm}
)";
  EXPECT_THAT(problems(in_plane + piston),
              ElementsAre("a.yaml:4:7: specimen.shapes[0].sphere is a map (belongs to scenes in "
                          "space only). Remove it."));
  const std::string in_space = R"(specimen:
  size: [1 mm, 2 mm, 3 mm]
  shapes:
    - disc: {centre: [0 m, 0 m], radius: 1 mm}
    - material: void
    - cylinder: {from: [0 m, 0 m, 0 m], to: [0 m, 0 m, 0 m], radius: 1 mm}
    - cylinder: {from: [0 m, 0 m, 0 m], to: [0 m, 0 m, 1 m], radius: 1 mm, inner_radius: 1 mm}
    - tubes: {lower: [0 m, 0 m, 0 m], upper: [1 m, 1 m, 0 m], cell_side: 1 mm, wall_thickness: 1 um}
)";
  EXPECT_THAT(problems(in_space + piston),
              ElementsAre("a.yaml:4:7: specimen.shapes[0].disc is a map (belongs to scenes in the "
                          "plane only). Remove it.",
                          "a.yaml:5:7: specimen.shapes[1].box is missing (what the shape is). Add "
                          "box, sphere, cylinder or tubes.",
                          "a.yaml:6:45: specimen.shapes[2].cylinder.to is [0 m, 0 m, 0 m] (is the "
                          "same point as from).",
                          "a.yaml:7:90: specimen.shapes[3].cylinder.inner_radius is 1 mm (must be "
                          "below radius).",
                          "a.yaml:8:46: specimen.shapes[4].tubes.upper is [1 m, 1 m, 0 m] (must be "
                          "above lower along z)."));
}

TEST_F(ScenesInSpace, APistonFromTheFrontNeedsSpace)
{
  EXPECT_THAT(problems(square + "loading: {piston: front, speed: 1 m/s}\n"),
              ElementsAre("a.yaml:4:19: loading.piston is 'front' (the scene lies in the plane). "
                          "Use left, right, bottom or top."));
}

TEST_F(ScenesInSpace, PeriodicSidesComeInPairsAndWithoutMargin)
{
  const std::string lateral = "loading: {piston: top, speed: 1 m/s, lateral: ";
  EXPECT_TRUE(problems(cuboid + lateral + "[periodic, periodic, free, rigid]}\n").empty());
  EXPECT_THAT(problems(cuboid + lateral + "[free, rigid, periodic, free]}\n"),
              ElementsAre("a.yaml:4:47: loading.lateral is ['free', 'rigid', 'periodic', 'free'] "
                          "(along z one side is periodic and the other is not). Make entries 3 and "
                          "4 both periodic, or neither."));
  EXPECT_THAT(problems(cuboid + lateral + "[periodic, periodic, free, free]}\n" +
                       "grid: {margin: [0 m, 1 um, 0 m, 0 m, 1 um, 1 um]}\n"),
              ElementsAre(HasSubstr("grid.margin is [0 m, 1 um, 0 m, 0 m, 1 um, 1 um] (the sides "
                                    "along x are periodic")));
  EXPECT_THAT(
      problems(square + "free_motion: {end_time: 1 us, sides: [free, free, free, periodic]}\n"),
      ElementsAre(HasSubstr("(along y one side is periodic and the other is not). Make entries 3 "
                            "and 4 both periodic, or neither.")));
}

}  // namespace
}  // namespace mpm::scene
