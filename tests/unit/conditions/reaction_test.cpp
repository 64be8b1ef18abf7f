// Reactions against sums over the nodes written out here.
#include <mpm/conditions/rigid_wall.hpp>

#include <algorithm>

#include "moving_nodes.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Sums over some tens of nodes with terms of size 10.
constexpr double rounding = 1e-12;

/// A piston in its ramp, from the right, over the nodes 4..7 of which this rank owns 4 and 5.
const WallPlacement placement{0, true, 2.5};
const WallMotion motion{-2, 1.0};
constexpr double time = 0.5, dt = 0.25;

template <class FreeVelocity>
Reaction<2> sum_over_owned_nodes(const MovingNodes<2>& nodes, FreeVelocity free_velocity)
{
  Reaction<2> sum;
  for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node) {
    const int column = nodes.index(node)[0];
    if (column < 4 || column > 5) continue;
    for (int d = 0; d < 2; ++d) {
      const double before = d == 0 ? motion.velocity(time) : 0;
      const double after = d == 0 ? motion.velocity(time + dt) : 0;
      const double impulse =
          nodes.grid.fields.mass_of(node) * (after - free_velocity(node, d, before));
      sum.impulse[d] += impulse;
      sum.work += impulse * 0.5 * (before + after);
    }
  }
  return sum;
}

void expect_equal(const Reaction<2>& a, const Reaction<2>& b)
{
  EXPECT_NEAR(a.impulse[0], b.impulse[0], rounding);
  EXPECT_NEAR(a.impulse[1], b.impulse[1], rounding);
  EXPECT_NEAR(a.work, b.work, rounding);
}

TEST(Reaction, OfIncrementsLeavesOutTheProjectionOntoTheWall)
{
  MovingNodes<2> nodes;
  RigidWall<2> piston(placement, motion, WallGrip::stick, ReactionBook::increments);
  piston.constrain_updated(nodes.grid.topology, nodes.grid.fields, time, dt);
  expect_equal(piston.take_reaction(),
               sum_over_owned_nodes(nodes, [](LocalIndex node, int d, double before) {
                 return before + MovingNodes<2>::increment(node, d);
               }));
}

TEST(Reaction, OfVelocitiesIsTheWholeChangeOfMomentum)
{
  MovingNodes<2> nodes;
  RigidWall<2> piston(placement, motion, WallGrip::stick, ReactionBook::velocities);
  piston.constrain_updated(nodes.grid.topology, nodes.grid.fields, time, dt);
  expect_equal(piston.take_reaction(),
               sum_over_owned_nodes(nodes, [](LocalIndex node, int d, double) {
                 return MovingNodes<2>::velocity(node, d);
               }));
}

TEST(Reaction, OfOneNodeByHand)
{
  // A resting node of 2 kg whose force would give it 0.5 m/s hits a piston of constant -3 m/s: the
  // increments' book sees 2 (-3 - (-3 + 0.5)) = -1 N s, the velocities' 2 (-3 - 0.5) = -7 N s, and
  // one of a quarter of the velocities 0.75 * -1 + 0.25 * -7.
  for (const auto& [book, impulse] :
       {std::pair{ReactionBook::increments, -1.0}, std::pair{ReactionBook::velocities, -7.0},
        std::pair{ReactionBook{0.25}, -2.5}}) {
    MovingNodes<2> nodes(1.9);
    std::ranges::fill(nodes.grid.fields.mass, 0.0);
    const LocalIndex node = nodes.grid.topology.index_of({5, 3});
    nodes.grid.fields.mass_of(node) = 2;
    nodes.grid.fields.updated_of(node)[0] = nodes.grid.fields.updated_of(node)[2] = 0.5;
    RigidWall<2> piston({0, true, 2.0}, {-3, 0}, WallGrip::slip, book);
    piston.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 1e-3);
    const Reaction<2> reaction = piston.take_reaction();
    EXPECT_DOUBLE_EQ(reaction.impulse[0], impulse);
    EXPECT_EQ(reaction.impulse[1], 0);
    EXPECT_DOUBLE_EQ(reaction.work, impulse * -3);
  }
}

TEST(Reaction, OfTwoRanksThatShareNodesCountsEachNodeOnce)
{
  // The same wall over one grid owned by one rank, and over two grids that overlap.
  const GridGeometry<2> geometry{{0, 0}, {1, 1}, {8, 5}};
  const IndexBox<2> whole{{0, 0}, {8, 5}};
  const auto reaction_of = [&](const IndexBox<2>& local, const IndexBox<2>& owned) {
    NodeGrid<2> grid(geometry, local, owned, 0);
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) grid.topology.touch(node);
    grid.end_activity(2);
    for (int i = local.lower[0]; i < local.upper[0]; ++i)
      for (int j = local.lower[1]; j < local.upper[1]; ++j) {
        const LocalIndex node = grid.topology.index_of({i, j});
        grid.fields.mass_of(node) = 1 + i;
        grid.fields.updated_of(node)[1] = -1.0 - j;
      }
    RigidWall<2> floor({1, false, 2.0}, {}, WallGrip::slip, ReactionBook::velocities);
    floor.constrain_updated(grid.topology, grid.fields, 0, 1);
    return floor.take_reaction().impulse[1];
  };
  const double alone = reaction_of(whole, whole);
  // masses 1 + ... + 8 = 36 times velocities 1 + 2 + 3
  EXPECT_DOUBLE_EQ(alone, 36 * 6);
  const IndexBox<2> left{{0, 0}, {4, 5}}, right{{4, 0}, {8, 5}};
  EXPECT_DOUBLE_EQ(reaction_of({{0, 0}, {6, 5}}, left) + reaction_of({{2, 0}, {8, 5}}, right),
                   alone);
  const IndexBox<2> below{{0, 0}, {8, 2}}, above{{0, 2}, {8, 5}};
  EXPECT_DOUBLE_EQ(reaction_of({{0, 0}, {8, 4}}, below) + reaction_of({{0, 1}, {8, 5}}, above),
                   alone);
}

TEST(Reaction, AddsUpUntilItIsTakenAndStartsAgainFromZero)
{
  MovingNodes<2> nodes;
  RigidWall<2> wall({1, false, 0.5}, {}, WallGrip::stick, ReactionBook::velocities);
  wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 1);
  const Reaction<2> once = wall.take_reaction();
  ASSERT_LT(once.impulse[0], 0);
  EXPECT_EQ(wall.take_reaction().impulse[0], 0);
  for (int k = 0; k < 2; ++k) {
    MovingNodes<2> again;
    wall.constrain_updated(again.grid.topology, again.grid.fields, 0, 1);
  }
  EXPECT_NEAR(wall.take_reaction().impulse[0], 2 * once.impulse[0], rounding);
}

TEST(Reaction, OfAWallAtRestDoesNoWork)
{
  MovingNodes<2> nodes;
  RigidWall<2> wall({0, false, 1.0}, {}, WallGrip::stick, ReactionBook::increments);
  wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 1);
  const Reaction<2> reaction = wall.take_reaction();
  EXPECT_NE(reaction.impulse[0], 0);
  EXPECT_EQ(reaction.work, 0);
}

}  // namespace
}  // namespace mpm
