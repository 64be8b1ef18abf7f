#include <mpm/micrograph/gaps.hpp>

#include "built_specimen.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

/// 12 cells of 1 m with 2 x 2 locations.
scene::Scene scene_of(std::vector<scene::Shape> shapes)
{
  scene::Scene scene;
  scene.materials = {scene::Material{.name = "wall", .values = {{"density", 1000.0}}}};
  scene.specimen.size = {12, 12, 12};
  scene.specimen.shapes = std::move(shapes);
  scene.grid.cells = {12, 12, 12};
  scene.grid.particles_per_cell = 2;
  return scene;
}

scene::Shape box(std::array<double, 3> lower, std::array<double, 3> upper)
{
  return {scene::Box{lower, upper}, "wall"};
}

/// The same for any number of parts.
template <int Dim = 2>
Gaps gaps_in(const scene::Scene& scene, int axis)
{
  const auto gaps_of = [&](const Share& share) {
    return gaps_along(built<Dim>(scene, share), std::span(scene.materials), axis, share);
  };
  const Gaps alone = gaps_of(Share{});
  for (const int parts : {2, 3, 7, 50})
    on_parts(parts, [&](const Share& share) {
      const Gaps shared = gaps_of(share);
      EXPECT_EQ(shared.early_contact, alone.early_contact);
      EXPECT_EQ(shared.layers, alone.layers);
    });
  return alone;
}

template <int Dim = 2>
double early_in(const scene::Scene& scene, int axis)
{
  return gaps_in<Dim>(scene, axis).early_contact;
}

TEST(Gaps, LayersCountWhatCanBeDeformed)
{
  scene::Scene scene = scene_of(
      {box({0, 0, 0}, {1, 12, 12}), box({4, 0, 0}, {6, 6, 12}), box({8, 0, 0}, {9, 12, 12})});
  scene.materials.push_back({.name = "rigid", .law = "rigid", .values = {}});
  scene.specimen.shapes[2].material = "rigid";
  EXPECT_THAT(gaps_in(scene, 0).layers,
              testing::ElementsAre(24, 24, 0, 0, 0, 0, 0, 0, 12, 12, 12, 12, 0, 0, 0, 0, 0, 0, 0, 0,
                                   0, 0, 0, 0));
  EXPECT_THAT(gaps_in<3>(scene, 0).layers[8], 12 * 24);
}

TEST(EarlyContact, OfEveryGapIsACell)
{
  const auto walls = scene_of(
      {box({0, 0, 0}, {1, 12, 12}), box({4, 0, 0}, {6, 12, 12}), box({9, 0, 0}, {12, 12, 12})});
  EXPECT_DOUBLE_EQ(early_in(walls, 0), 2.0 / 12);
  EXPECT_DOUBLE_EQ(early_in<3>(walls, 0), 2.0 / 12);
  EXPECT_EQ(early_in(walls, 1), 0);  // along the walls nothing closes
}

TEST(EarlyContact, OfAGapNarrowerThanACellIsItsWidth)
{
  EXPECT_DOUBLE_EQ(
      early_in(scene_of({box({0, 0, 0}, {4, 12, 12}), box({4.5, 0, 0}, {12, 12, 12})}), 0),
      0.5 / 12);
}

TEST(EarlyContact, IsTheMeanOverAllLines)
{
  // A lumen of 6 by 3 in the middle of a solid: it lies on half of the lines along y, and on a
  // quarter of those along x.
  const auto lumen = scene_of({box({0, 0, 0}, {3, 12, 12}), box({9, 0, 0}, {12, 12, 12}),
                               box({0, 0, 0}, {12, 4, 12}), box({0, 7, 0}, {12, 12, 12})});
  EXPECT_DOUBLE_EQ(early_in(lumen, 1), 0.5 / 12);
  EXPECT_DOUBLE_EQ(early_in(lumen, 0), 0.25 / 12);
}

TEST(EarlyContact, CountsWhatLiesBehindSomething)
{
  EXPECT_DOUBLE_EQ(early_in(scene_of({box({3, 0, 0}, {6, 12, 12})}), 0), 1.0 / 12);
  EXPECT_EQ(early_in(scene_of({box({3, 0, 0}, {12, 12, 12})}), 0), 0);
}

}  // namespace
}  // namespace mpm::micrograph::test
