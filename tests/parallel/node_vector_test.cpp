/// Rows of active nodes, and values on their way to a vector and back.

#include <mpm/core/error.hpp>

#include <limits>

#include "active_nodes.hpp"
#include <petscdmda.h>

namespace mpm {
namespace {

template <class DimTag>
using NodeVector = OnActiveNodes<DimTag>;
TYPED_TEST_SUITE(NodeVector, Dimensions);

TYPED_TEST(NodeVector, EveryActiveNodeHasOneRowThatAllItsRanksKnow)
{
  constexpr int dim = TestFixture::dim;
  for (const bool periodic : {false, true}) {
    GridGeometry<dim> geometry = oblong_grid<dim>();
    geometry.periodic[0] = periodic;
    TestFixture::on_all_maps(
        geometry, TestFixture::ball(geometry), [&](const ActiveNodes<dim>& active) {
          const IndexBox<dim> grid{IndexVec<dim>::Zero(), geometry.nodes};
          // Row by node of the grid, from the owners.
          std::vector<double> row_of(grid.size(), 0.0), owners(grid.size(), 0.0);
          for (const LocalIndex node : active.rows().owned()) {
            row_of[number_in(grid, active.topology().index(node))] = double(active.rows().of(node));
            owners[number_in(grid, active.topology().index(node))] += 1;
          }
          sum_over_ranks(MPI_COMM_WORLD, row_of);
          sum_over_ranks(MPI_COMM_WORLD, owners);
          std::vector<int> holders(active.rows().count(), 0);
          for_each_index(grid, [&](const IndexVec<dim>& node) {
            const LocalIndex at = number_in(grid, node);
            EXPECT_EQ(owners[at], active.is_active(node) ? 1 : 0);
            if (owners[at] == 1) ++holders[std::size_t(row_of[at])];
          });
          EXPECT_THAT(holders, ::testing::Each(1));
          EXPECT_LT(active.rows().count(), grid.size()) << "some nodes must be inactive";

          for (LocalIndex node = 0; node < active.topology().size(); ++node) {
            const IndexVec<dim> at = active.topology().index(node);
            const IndexVec<dim> in_grid = geometry.wrapped(at);
            const bool here = active.is_active(at) && active.reaches(at);
            EXPECT_EQ(active.rows().of(node),
                      here ? GlobalIndex(row_of[number_in(grid, in_grid)]) : -1)
                << "node " << at.transpose();
          }
        });
  }
}

TYPED_TEST(NodeVector, RowsOfCutsFollowTheNumbersOfTheDmda)
{
  constexpr int dim = TestFixture::dim;
  const GridGeometry<dim> geometry = oblong_grid<dim>();
  const ActiveNodes<dim> active(maps_of(geometry)[0], TestFixture::ball(geometry));
  // The application ordering knows the DMDA's number of every node of the grid.
  std::vector<PetscInt> numbers;
  const IndexBox<dim> grid{IndexVec<dim>::Zero(), geometry.nodes};
  for_each_index(grid,
                 [&](const IndexVec<dim>& node) { numbers.push_back(number_in(grid, node)); });
  AO ordering;
  ASSERT_EQ(DMDAGetAO(active.decomposition().dmda(), &ordering), 0);
  ASSERT_EQ(AOApplicationToPetsc(ordering, PetscInt(numbers.size()), numbers.data()), 0);
  std::vector<PetscInt> of_active;
  for_each_index(grid, [&](const IndexVec<dim>& node) {
    if (active.is_active(node)) of_active.push_back(numbers[number_in(grid, node)]);
  });
  std::ranges::sort(of_active);
  for (const LocalIndex node : active.rows().owned()) {
    const PetscInt number = numbers[number_in(grid, active.topology().index(node))];
    const auto place = std::ranges::lower_bound(of_active, number) - of_active.begin();
    EXPECT_EQ(active.rows().of(node), place);
  }
}

TYPED_TEST(NodeVector, ValuesGoToAVectorAndBackToEveryRankThatReachesTheirNode)
{
  constexpr int dim = TestFixture::dim;
  constexpr int stride = dim + 2;  // the column is part of a record
  GridGeometry<dim> geometry = oblong_grid<dim>();
  geometry.periodic[0] = true;
  TestFixture::on_all_maps(
      geometry, TestFixture::ball(geometry), [&](const ActiveNodes<dim>& active) {
        const GridTopology<dim>& topology = active.topology();
        const IndexBox<dim> grid{IndexVec<dim>::Zero(), geometry.nodes};
        const auto value = [&](LocalIndex node, int component) {
          const LocalIndex number = number_in(grid, geometry.wrapped(topology.index(node)));
          return std::sqrt(2.0 + number) * (component + 1);  // a full mantissa
        };
        constexpr double nobodys = -7;
        std::vector<double> values(std::size_t(topology.size()) * stride, nobodys);
        const NodeColumn column{values.data() + 1, stride, dim};
        for (const LocalIndex node : active.rows().owned())
          for (int c = 0; c < dim; ++c) column.values[node * stride + c] = value(node, c);
        const VectorHandle vector = active.rows().vector(dim);
        active.rows().to_vector(column, vector.get());
        std::ranges::fill(values, nobodys);
        active.rows().from_vector(vector.get(), column);
        // The same bits: nothing is added to a value but zeros.
        for (LocalIndex node = 0; node < topology.size(); ++node) {
          const bool here = active.rows().of(node) >= 0;
          for (int c = 0; c < dim; ++c)
            EXPECT_EQ(column.values[node * stride + c], here ? value(node, c) : 0);
          EXPECT_EQ(values[node * stride], nobodys);
          EXPECT_EQ(values[node * stride + dim + 1], nobodys);
        }
      });
}

TYPED_TEST(NodeVector, MoreUnknownsThanPetscCountsAreRefusedEverywhere)
{
  constexpr int dim = TestFixture::dim;
  if (sizeof(PetscInt) > sizeof(int)) GTEST_SKIP() << "this PETSc counts that far";
  const GridGeometry<dim> geometry = oblong_grid<dim>();
  const ActiveNodes<dim> active(maps_of(geometry)[0], TestFixture::ball(geometry));
  const int width = std::numeric_limits<int>::max() / int(active.rows().count()) + 1;
  try {
    active.rows().vector(width);
    ADD_FAILURE() << "a vector of so many entries";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("64-bit indices"));
  }
  EXPECT_THROW(active.rows().matrix(width, 1), InputError);
}

}  // namespace
}  // namespace mpm
