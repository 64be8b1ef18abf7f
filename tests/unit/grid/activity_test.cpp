
#include <algorithm>
#include <set>

#include "node_grid.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using testing::Each;

constexpr double mark = 7;

/// A local box that does not start at node 0 of the run.
NodeGrid<2> plane_grid()
{
  const IndexBox<2> local{{10, 20}, {30, 36}};
  return {{{0, 0}, {0.5, 0.25}, {50, 50}}, local, local, 0};
}

NodeGrid<3> space_grid()
{
  const IndexBox<3> local{{1, 2, 3}, {11, 12, 13}};
  return {{{0, 0, 0}, {1, 1, 1}, {20, 20, 20}}, local, local, 0};
}

template <int Dim>
std::set<LocalIndex> nodes_of_runs(const NodeGrid<Dim>& grid)
{
  std::set<LocalIndex> nodes;
  for (const NodeRun<Dim>& run : grid.topology.runs()) {
    EXPECT_EQ(grid.topology.index_of(run.start), run.first);
    for (LocalIndex k = 0; k < run.length; ++k)
      EXPECT_TRUE(nodes.insert(run.first + k).second) << "in two runs";
  }
  return nodes;
}

template <int Dim>
std::set<LocalIndex> nodes_of_box(const NodeGrid<Dim>& grid, const IndexBox<Dim>& box)
{
  std::set<LocalIndex> nodes;
  for (LocalIndex node = 0; node < grid.topology.size(); ++node) {
    IndexVec<Dim> at;
    for (int d = 0; d < Dim; ++d)
      at[d] = grid.topology.local().lower[d] +
              node / grid.topology.stride(d) % grid.topology.local().count()[d];
    if (box.contains(at)) nodes.insert(node);
  }
  return nodes;
}

template <int Dim>
void activate(NodeGrid<Dim>& grid, std::vector<IndexVec<Dim>> first_nodes, int support)
{
  grid.topology.begin_activity();
  for (const IndexVec<Dim>& node : first_nodes) grid.topology.touch(grid.topology.index_of(node));
  grid.end_activity(support);
}

TEST(Activity, CoversAStencilAndOneNodeAroundIt)
{
  NodeGrid<2> grid = plane_grid();
  activate<2>(grid, {{15, 25}}, 3);
  EXPECT_EQ(nodes_of_runs(grid), nodes_of_box<2>(grid, {{14, 24}, {19, 29}}));
  EXPECT_EQ(grid.topology.active_nodes(), 25);
}

TEST(Activity, CoversAStencilAndOneNodeAroundItInSpace)
{
  NodeGrid<3> grid = space_grid();
  activate<3>(grid, {{5, 6, 7}}, 2);
  EXPECT_EQ(nodes_of_runs(grid), nodes_of_box<3>(grid, {{4, 5, 6}, {8, 9, 10}}));
}

TEST(Activity, EndsAtTheEdgeOfTheLocalNodes)
{
  NodeGrid<2> grid = plane_grid();
  activate<2>(grid, {{10, 20}, {28, 34}}, 2);
  std::set<LocalIndex> expected = nodes_of_box<2>(grid, {{10, 20}, {13, 23}});
  expected.merge(nodes_of_box<2>(grid, {{27, 33}, {30, 36}}));
  EXPECT_EQ(nodes_of_runs(grid), expected);
}

TEST(Activity, OfOverlappingStencilsCountsEachNodeOnce)
{
  NodeGrid<2> grid = plane_grid();
  activate<2>(grid, {{15, 25}, {17, 25}, {21, 25}}, 2);
  EXPECT_EQ(nodes_of_runs(grid), nodes_of_box<2>(grid, {{14, 24}, {24, 28}}));
}

TEST(Activity, KeepsSharedNodesAndTheirNeighboursWhereverParticlesAre)
{
  NodeGrid<2> grid = plane_grid();
  grid.topology.keep_active({grid.topology.index_of({12, 22})});
  activate<2>(grid, {{25, 30}}, 2);
  std::set<LocalIndex> expected = nodes_of_box<2>(grid, {{11, 21}, {14, 24}});
  expected.merge(nodes_of_box<2>(grid, {{24, 29}, {28, 33}}));
  EXPECT_EQ(nodes_of_runs(grid), expected);
}

template <int Dim>
void fill_all(NodeGrid<Dim>& grid)
{
  for (LaneVector<double>* values :
       {&grid.fields.mass, &grid.fields.momentum_force, &grid.fields.updated,
        &grid.fields.remapped_momentum, &grid.fields.gradient_velocity})
    std::ranges::fill(*values, mark);
}

/// All values of a node, whatever they mean.
template <int Dim>
std::vector<double> values_at(const NodeGrid<Dim>& grid, LocalIndex node)
{
  std::vector<double> values{grid.fields.mass_of(node)};
  const auto append = [&](const LaneVector<double>& all, int width) {
    values.insert(values.end(), all.begin() + node * width, all.begin() + (node + 1) * width);
  };
  append(grid.fields.momentum_force, NodeFields<Dim>::record_width);
  append(grid.fields.updated, NodeFields<Dim>::record_width);
  append(grid.fields.remapped_momentum, NodeFields<Dim>::remap_width);
  append(grid.fields.gradient_velocity, NodeFields<Dim>::velocity_width);
  return values;
}

template <int Dim>
void expect_work_stays_inside_the_runs(NodeGrid<Dim> grid, const IndexVec<Dim>& first_node)
{
  fill_all(grid);
  activate<Dim>(grid, {first_node}, 2);
  const std::set<LocalIndex> active = nodes_of_runs(grid);
  ASSERT_LT(LocalIndex(active.size()), grid.topology.size());
  grid.fields.reset(grid.topology.runs());
  grid.fields.reset_remap(grid.topology.runs());
  grid.fields.update_velocity(grid.topology.runs(), 1);
  grid.fields.gradient_from_momentum(grid.topology.runs());
  grid.fields.gradient_from_remap(grid.topology.runs());
  grid.fields.gradient_from_updated(grid.topology.runs());
  for (LocalIndex node = 0; node < grid.topology.size(); ++node)
    if (active.contains(node)) {
      EXPECT_EQ(grid.fields.mass_of(node), 0);
      EXPECT_EQ(grid.fields.momentum_force[node * NodeFields<Dim>::record_width], 0);
      EXPECT_EQ(grid.fields.updated[node * NodeFields<Dim>::record_width], 0);
      EXPECT_EQ(grid.fields.remapped_momentum[node * NodeFields<Dim>::remap_width], 0);
    } else {
      EXPECT_THAT(values_at(grid, node), Each(mark)) << "node " << node;
    }
}

TEST(Activity, LeavesNodesOutsideTheRunsUntouchedInThePlane)
{
  expect_work_stays_inside_the_runs<2>(plane_grid(), {20, 30});
}

TEST(Activity, LeavesNodesOutsideTheRunsUntouchedInSpace)
{
  expect_work_stays_inside_the_runs<3>(space_grid(), {4, 5, 6});
}

template <int Dim>
void expect_zeros_where_particles_left(NodeGrid<Dim> grid, const IndexVec<Dim>& here,
                                       const IndexVec<Dim>& there)
{
  activate<Dim>(grid, {here}, 3);
  fill_all(grid);
  std::set<LocalIndex> left = nodes_of_runs(grid);
  activate<Dim>(grid, {there}, 3);
  for (const LocalIndex node : nodes_of_runs(grid)) left.erase(node);
  ASSERT_FALSE(left.empty());
  for (const LocalIndex node : left)
    EXPECT_THAT(values_at(grid, node), Each(0.0)) << "node " << node;
  // What stays active keeps its values: activity is renewed in the middle of a step.
  for (const LocalIndex node : nodes_of_runs(grid))
    EXPECT_THAT(values_at(grid, node), Each(mark)) << "node " << node;
}

TEST(Activity, LeavesZerosWhereParticlesWentAway)
{
  expect_zeros_where_particles_left<2>(plane_grid(), {15, 25}, {17, 26});
  expect_zeros_where_particles_left<3>(space_grid(), {4, 5, 6}, {5, 5, 8});
}

}  // namespace
}  // namespace mpm
