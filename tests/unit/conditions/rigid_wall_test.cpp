#include <mpm/conditions/rigid_wall.hpp>

#include "moving_nodes.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Compares every node with what a wall at `face` makes of it.
template <int Dim>
void expect_wall(MovingNodes<Dim>& nodes, const WallPlacement& placement, double face,
                 double wall_velocity, WallGrip grip)
{
  int behind_count = 0;
  for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node) {
    const double x = nodes.coordinate(node, placement.axis);
    // Behind the face or at most half a cell in front of it, with some room for rounding.
    const double in_front = (placement.upper ? face - x : x - face) /
                            nodes.grid.topology.geometry().spacing[placement.axis];
    const bool behind = in_front <= 0.5 + 1e-10;
    behind_count += behind;
    for (int d = 0; d < Dim; ++d) {
      const bool normal = d == placement.axis;
      const bool follows = behind && (normal || grip == WallGrip::stick);
      const double expected = follows ? (normal ? wall_velocity : 0.0) : nodes.velocity(node, d);
      EXPECT_EQ(nodes.updated(node, d), expected) << "node " << node << ", component " << d;
      EXPECT_EQ(nodes.gradient(node, d), expected) << "node " << node << ", component " << d;
    }
  }
  EXPECT_GT(behind_count, 0);
  EXPECT_LT(behind_count, nodes.grid.topology.size());
}

class WallEverywhere : public testing::TestWithParam<std::tuple<bool, WallGrip>> {};

template <int Dim>
void try_all_axes(bool upper, WallGrip grip)
{
  for (int axis = 0; axis < Dim; ++axis)
    for (const double cells : {3.0, 3.3, 3.7}) {
      MovingNodes<Dim> nodes;
      const double face = cells * nodes.grid.topology.geometry().spacing[axis];
      const WallPlacement placement{axis, upper, face};
      RigidWall<Dim> wall(placement, {}, grip, ReactionBook::increments);
      wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 1);
      wall.constrain_gradient(nodes.grid.topology, nodes.grid.fields, 0, 1);
      expect_wall(nodes, placement, face, 0, grip);
    }
}

TEST_P(WallEverywhere, HoldsTheNodeNearestToItsFaceAndThoseBehindAndNoOthers)
{
  const auto [upper, grip] = GetParam();
  try_all_axes<2>(upper, grip);
  try_all_axes<3>(upper, grip);
}

INSTANTIATE_TEST_SUITE_P(SidesAndGrips, WallEverywhere,
                         testing::Combine(testing::Bool(),
                                          testing::Values(WallGrip::stick, WallGrip::slip)));

TEST(RigidWall, MidwayBetweenTwoNodesHoldsTheOneInFrontWhateverTheRounding)
{
  for (const bool upper : {false, true})
    for (const double hair : {-1e-13, 0.0, 1e-13}) {
      MovingNodes<2> nodes;
      const WallPlacement placement{1, upper, 1.125 + hair};  // between 4 and 5 along y
      RigidWall<2> wall(placement, {}, WallGrip::slip, ReactionBook::increments);
      wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 1);
      wall.constrain_gradient(nodes.grid.topology, nodes.grid.fields, 0, 1);
      expect_wall(nodes, placement, 1.125, 0, WallGrip::slip);
    }
}

TEST(RigidWall, AMovingOneHoldsTheNodesOfItsPlaceAtTheEndOfTheStep)
{
  // From 3.8 m with -2 m/s: in the step from 0.2 to 0.3 s it goes from 3.4 m, where node 7 is the
  // nearest, to 3.2 m, where node 6 is.
  const WallPlacement placement{0, true, 3.8};
  const WallMotion motion{-2, 0};
  MovingNodes<2> nodes;
  RigidWall<2> wall(placement, motion, WallGrip::stick, ReactionBook::velocities);
  wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0.2, 0.1);
  wall.constrain_gradient(nodes.grid.topology, nodes.grid.fields, 0.2, 0.1);
  expect_wall(nodes, placement, 3.2, -2, WallGrip::stick);
  EXPECT_NEAR(wall.position(0.3), 3.2, 1e-15);
}

TEST(RigidWall, GivesNodesInItsRampTheVelocityAtTheEndOfTheStepAndTheChangeAsIncrement)
{
  const WallMotion motion{-2, 1.0};  // V(0.5) = -1, V(0.75) = -2 (3 * 0.5625 - 2 * 0.421875)
  MovingNodes<2> nodes;
  RigidWall<2> wall({0, true, 3.5}, motion, WallGrip::stick, ReactionBook::increments);
  wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0.5, 0.25);
  const LocalIndex node = nodes.grid.topology.index_of({7, 3});
  EXPECT_DOUBLE_EQ(nodes.updated(node, 0), -1.6875);
  EXPECT_DOUBLE_EQ(nodes.grid.fields.updated_of(node)[2], -0.6875);
  EXPECT_EQ(nodes.updated(node, 1), 0);
  EXPECT_EQ(nodes.grid.fields.updated_of(node)[3], 0);
}

TEST(RigidWall, LeavesNodesWithoutMassAlone)
{
  MovingNodes<2> nodes(1.5);  // nodes up to number 50 weigh less
  RigidWall<2> wall({1, true, 0.0}, {}, WallGrip::stick, ReactionBook::increments);
  wall.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 1);
  for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node)
    EXPECT_EQ(nodes.updated(node, 0), node <= 50 ? nodes.velocity(node, 0) : 0.0);
}

TEST(RigidWall, MeasuresHowFarAParticleIsBehindItsFace)
{
  const RigidWall<2> lower({1, false, 1.0}, {}, WallGrip::slip, ReactionBook::increments);
  EXPECT_DOUBLE_EQ(lower.depth(0.75, 0), 0.25);
  EXPECT_DOUBLE_EQ(lower.depth(1.5, 0), -0.5);
  const RigidWall<2> piston({0, true, 4.0}, {-1, 0}, WallGrip::stick, ReactionBook::increments);
  EXPECT_DOUBLE_EQ(piston.depth(3.5, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(piston.depth(2.5, 1.0), -0.5);
}

}  // namespace
}  // namespace mpm
