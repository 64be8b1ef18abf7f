
#include "node_grid.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using testing::ElementsAre;

constexpr double mass_cut = 1e-10;

/// All nodes active; `heavy` with mass 2 kg and `light` with less than the cut.
template <int Dim>
struct TwoNodes {
  static IndexBox<Dim> box() { return {IndexVec<Dim>::Zero(), IndexVec<Dim>::Constant(4)}; }
  static GridGeometry<Dim> geometry()
  {
    return {Vec<Dim>::Zero(), Vec<Dim>::Ones(), IndexVec<Dim>::Constant(4)};
  }

  NodeGrid<Dim> grid{geometry(), box(), box(), mass_cut};
  LocalIndex heavy = grid.topology.index_of(IndexVec<Dim>::Constant(2));
  LocalIndex light = grid.topology.index_of(IndexVec<Dim>::Constant(1));

  TwoNodes()
  {
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) grid.topology.touch(node);
    grid.end_activity(2);
    put(heavy, 2.0);
    put(light, 0.5 * mass_cut);
  }
  void put(LocalIndex node, double mass)
  {
    grid.fields.mass_of(node) = mass;
    for (int d = 0; d < Dim; ++d) {
      grid.fields.momentum_force[node * NodeFields<Dim>::record_width + d] = 6 + d;  // kg m/s
      grid.fields.momentum_force[node * NodeFields<Dim>::record_width + Dim + d] = -10 - d;  // N
      grid.fields.remapped_momentum[node * NodeFields<Dim>::remap_width + d] = 20 + d;
    }
  }
  std::vector<double> updated(LocalIndex node)
  {
    const double* u = grid.fields.updated_of(node);
    return {u, u + 2 * Dim};
  }
  std::vector<double> gradient_velocity(LocalIndex node)
  {
    const double* v = grid.fields.gradient_velocity_of(node);
    return {v, v + NodeFields<Dim>::velocity_width};
  }
};

TEST(NodeVelocity, IsMomentumOverMassPlusTheIncrementOfTheForce)
{
  TwoNodes<2> nodes;
  nodes.grid.fields.update_velocity(nodes.grid.topology.runs(), 0.5);
  // v = 6 / 2, dv = 0.5 * -10 / 2; and 7 / 2, 0.5 * -11 / 2
  EXPECT_THAT(nodes.updated(nodes.heavy), ElementsAre(3 - 2.5, 3.5 - 2.75, -2.5, -2.75));
}

TEST(NodeVelocity, IsTheSameFormulaInSpace)
{
  TwoNodes<3> nodes;
  nodes.grid.fields.update_velocity(nodes.grid.topology.runs(), 0.5);
  EXPECT_THAT(nodes.updated(nodes.heavy), ElementsAre(3 - 2.5, 3.5 - 2.75, 4 - 3, -2.5, -2.75, -3));
}

TEST(NodeVelocity, OfANodeBelowTheMassCutIsZero)
{
  TwoNodes<2> nodes;
  nodes.grid.fields.update_velocity(nodes.grid.topology.runs(), 0.5);
  nodes.grid.fields.gradient_from_remap(nodes.grid.topology.runs());
  EXPECT_FALSE(nodes.grid.fields.is_active(nodes.light));
  EXPECT_TRUE(nodes.grid.fields.is_active(nodes.heavy));
  EXPECT_THAT(nodes.updated(nodes.light), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(nodes.gradient_velocity(nodes.light), ElementsAre(0, 0, 0, 0));
}

TEST(GradientVelocity, ComesFromTheMomentumTheRemapOrTheUpdatedVelocity)
{
  TwoNodes<2> nodes;
  nodes.grid.fields.gradient_from_momentum(nodes.grid.topology.runs());
  EXPECT_THAT(nodes.gradient_velocity(nodes.heavy), ElementsAre(3, 3.5, 3, 3.5));
  nodes.grid.fields.gradient_from_remap(nodes.grid.topology.runs());
  EXPECT_THAT(nodes.gradient_velocity(nodes.heavy), ElementsAre(10, 10.5, 10, 10.5));
  nodes.grid.fields.update_velocity(nodes.grid.topology.runs(), 0.5);
  nodes.grid.fields.gradient_from_updated(nodes.grid.topology.runs());
  EXPECT_THAT(nodes.gradient_velocity(nodes.heavy), ElementsAre(0.5, 0.75, 0.5, 0.75));
}

TEST(GradientVelocity, HasThreeComponentsInSpace)
{
  TwoNodes<3> nodes;
  nodes.grid.fields.gradient_from_momentum(nodes.grid.topology.runs());
  EXPECT_THAT(nodes.gradient_velocity(nodes.heavy), ElementsAre(3, 3.5, 4, 0));
  nodes.grid.fields.gradient_from_remap(nodes.grid.topology.runs());
  EXPECT_THAT(nodes.gradient_velocity(nodes.heavy), ElementsAre(10, 10.5, 11, 0));
  nodes.grid.fields.update_velocity(nodes.grid.topology.runs(), 0.5);
  nodes.grid.fields.gradient_from_updated(nodes.grid.topology.runs());
  EXPECT_THAT(nodes.gradient_velocity(nodes.heavy), ElementsAre(0.5, 0.75, 1, 0));
}

}  // namespace
}  // namespace mpm
