#include <mpm/conditions/rigid_body.hpp>

#include "moving_nodes.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

template <int Dim>
std::array<WallMotion, Dim> steadily(const Vec<Dim>& velocity)
{
  std::array<WallMotion, Dim> motion;
  for (int d = 0; d < Dim; ++d) motion[d].speed = velocity[d];
  return motion;
}

/// Checks that exactly the nodes in [lower, upper] move with `velocity`.
template <int Dim>
void expect_moving_box(MovingNodes<Dim>& nodes, const IndexVec<Dim>& lower,
                       const IndexVec<Dim>& upper, const Vec<Dim>& velocity)
{
  const IndexBox<Dim> inside{lower, upper + IndexVec<Dim>::Ones()};
  for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node)
    for (int d = 0; d < Dim; ++d) {
      const double expected =
          inside.contains(nodes.index(node)) ? velocity[d] : nodes.velocity(node, d);
      EXPECT_EQ(nodes.updated(node, d), expected) << "node " << node << ", component " << d;
      EXPECT_EQ(nodes.gradient(node, d), expected) << "node " << node << ", component " << d;
    }
}

TEST(RigidBody, MovesTheNodesOnAndInsideItsBoxes)
{
  // Boxes of 0.5 x 0.5 m around (1.25, 1) and (1.75, 1): [1, 2] x [0.75, 1.25] m, nodes 2..4, 3..5.
  MovingNodes<2> nodes;
  const Vec<2> velocity(3, -2);
  RigidBody<2> body({{1.25, 1.0}, {1.75, 1.0}}, {0.25, 0.25}, steadily<2>(velocity),
                    ReactionBook::increments);
  body.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 0);
  body.constrain_gradient(nodes.grid.topology, nodes.grid.fields, 0, 0);
  expect_moving_box<2>(nodes, {2, 3}, {4, 5}, velocity);
}

TEST(RigidBody, TakesItsPlaceAtTheEndOfTheStep)
{
  MovingNodes<2> nodes;
  const Vec<2> velocity(1, 0.5);
  RigidBody<2> body({{0.5, 0.5}}, {0.5, 0.25}, steadily<2>(velocity), ReactionBook::increments);
  body.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0.75,
                         0.25);  // [1, 2] x [0.75, 1.25] m after 1 s
  body.constrain_gradient(nodes.grid.topology, nodes.grid.fields, 0.75, 0.25);
  expect_moving_box<2>(nodes, {2, 3}, {4, 5}, velocity);
}

TEST(RigidBody, MovesNodesInSpace)
{
  MovingNodes<3> nodes;
  const Vec<3> velocity(0, 0, 4);
  RigidBody<3> body({{1, 1, 3}}, {0.6, 0.3, 1.1}, steadily<3>(velocity), ReactionBook::velocities);
  body.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 0.25);  // z: 4 +- 1.1 m
  body.constrain_gradient(nodes.grid.topology, nodes.grid.fields, 0, 0.25);
  expect_moving_box<3>(nodes, {1, 3, 3}, {3, 5, 5}, velocity);
}

TEST(RigidBody, AsWideAsAPeriodHoldsTheSeamFromBothSides)
{
  // [0, 0.5] x [0.75, 1.25] m and [4, 4.5] x [1.5, 2] m, in a period of 4.5 m.
  MovingNodes<2> nodes(0, true);
  RigidBody<2> body({{0.25, 1.0}, {4.25, 1.75}}, {0.25, 0.25}, steadily<2>({3, -2}),
                    ReactionBook::increments);
  body.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 0);
  for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node) {
    const IndexVec<2> at = nodes.index(node);
    const bool held = at[1] >= 3 && ((at[0] <= 1 && at[1] <= 5) || (at[0] == 0 && at[1] >= 6));
    EXPECT_EQ(nodes.updated(node, 0), held ? 3 : nodes.velocity(node, 0)) << at.transpose();
  }
}

TEST(RigidBody, OutsideThisRanksNodesDoesNothing)
{
  MovingNodes<2> nodes;
  RigidBody<2> body({{50, 50}, {-50, 1}}, {0.5, 0.5}, steadily<2>({1, 0}),
                    ReactionBook::increments);
  body.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 0.25);
  EXPECT_EQ(body.take_reaction().impulse.norm(), 0);
  for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node)
    EXPECT_EQ(nodes.updated(node, 0), nodes.velocity(node, 0));
}

TEST(RigidBody, BooksEachOwnedNodeOnceAlsoWhereItsBoxesMeet)
{
  // Nodes 5 and 6 along x, 3..5 along y; node 6 belongs to another rank.
  MovingNodes<2> nodes;
  const Vec<2> velocity(-3, 0);
  RigidBody<2> body({{2.75, 0.875}, {2.75, 1.125}}, {0.25, 0.125}, steadily<2>(velocity),
                    ReactionBook::velocities);
  double impulse = 0;
  for (int j = 3; j <= 5; ++j) {
    const LocalIndex node = nodes.grid.topology.index_of({5, j});
    impulse += nodes.grid.fields.mass_of(node) * (-3 - nodes.velocity(node, 0));
  }
  body.constrain_updated(nodes.grid.topology, nodes.grid.fields, 0, 0);
  const Reaction<2> reaction = body.take_reaction();
  EXPECT_NEAR(reaction.impulse[0], impulse, 1e-13);  // three terms of size 10
  EXPECT_NEAR(reaction.work, -3 * impulse, 1e-12);
}

}  // namespace
}  // namespace mpm
