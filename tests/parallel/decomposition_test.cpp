#include <mpm/core/error.hpp>
#include <mpm/parallel/decomposition.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>

namespace mpm {
namespace {

using ::testing::HasSubstr;

template <int Dim>
using Weights = std::array<std::vector<double>, Dim>;

template <int Dim>
GridGeometry<Dim> grid_of(const IndexVec<Dim>& nodes)
{
  return {Vec<Dim>::Constant(-0.5), Vec<Dim>::Constant(0.25), nodes};
}

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}

template <int Dim, class Visit>
void for_each_index(const IndexVec<Dim>& count, Visit visit)
{
  for (GlobalIndex k = 0; k < count.template cast<GlobalIndex>().prod(); ++k) {
    GlobalIndex rest = k;
    IndexVec<Dim> index;
    for (int d = 0; d < Dim; ++d) {
      index[d] = LocalIndex(rest % count[d]);
      rest /= count[d];
    }
    visit(index);
  }
}

/// Every node belongs to the box of the rank that owner_of_cell names, and to no other.
template <int Dim>
void expect_a_tiling(const Decomposition<Dim>& decomposition)
{
  for_each_index<Dim>(decomposition.geometry().nodes, [&](const IndexVec<Dim>& node) {
    const int owner = decomposition.owner_of_cell(node);
    int owners = 0;
    for (int rank = 0; rank < decomposition.ranks(); ++rank)
      owners += decomposition.owned(rank).contains(node);
    EXPECT_EQ(owners, 1) << "node " << node.transpose();
    EXPECT_TRUE(decomposition.owned(owner).contains(node)) << "node " << node.transpose();
  });
  for (int rank = 0; rank < decomposition.ranks(); ++rank)
    EXPECT_GE(decomposition.owned(rank).count().minCoeff(), std::min(2, decomposition.ranks()))
        << "rank " << rank;
}

/// One-sided: each of the last quarter of the layers weighs nine times one of the others.
std::vector<double> one_sided(LocalIndex layers)
{
  std::vector<double> weights(layers, 1.0);
  std::fill(weights.begin() + 3 * layers / 4, weights.end(), 9.0);
  return weights;
}

TEST(Decomposition, BoxesTileAPlaneGridOnce)
{
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({37, 23}), {0, 0}, {}, {});
  EXPECT_EQ(decomposition.ranks(), ranks());
  expect_a_tiling(decomposition);
}

TEST(Decomposition, BoxesTileASpatialGridOnce)
{
  const Decomposition<3> decomposition(MPI_COMM_WORLD, grid_of<3>({13, 9, 17}), {0, 0, 0}, {}, {});
  EXPECT_EQ(decomposition.ranks(), ranks());
  expect_a_tiling(decomposition);
}

TEST(Decomposition, OneSidedWeightsInTwoAxesStillTileTheGrid)
{
  const Weights<2> weights{one_sided(40), one_sided(32)};
  expect_a_tiling(Decomposition<2>(MPI_COMM_WORLD, grid_of<2>({40, 32}), {0, 0}, weights, {}));
}

TEST(Decomposition, EveryRankKnowsTheSameBoxes)
{
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({41, 29}), {0, 0},
                                       {one_sided(41), {}}, {});
  EXPECT_EQ(decomposition.rank(), rank_of(MPI_COMM_WORLD));
  std::vector<LocalIndex> mine;
  for (int rank = 0; rank < ranks(); ++rank) {
    const IndexBox<2> box = decomposition.owned(rank);
    mine.insert(mine.end(), {box.lower[0], box.lower[1], box.upper[0], box.upper[1]});
  }
  std::vector<LocalIndex> first = mine;
  MPI_Bcast(first.data(), int(first.size()), MPI_INT32_T, 0, MPI_COMM_WORLD);
  EXPECT_EQ(mine, first);
}

TEST(Decomposition, CellsOutsideTheGridBelongToTheNearestPart)
{
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({20, 20}), {0, 0}, {}, {});
  EXPECT_EQ(decomposition.owner_of_cell({-3, -1}), 0);
  EXPECT_EQ(decomposition.owner_of_cell({20, 25}), ranks() - 1);
}

TEST(Decomposition, LocalBoxHoldsTheStencilsOfParticlesOneCellOutside)
{
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({40, 40}), {0, 0}, {}, {});
  for (const int support : {2, 3})
    for (int rank = 0; rank < ranks(); ++rank) {
      const IndexBox<2> owned = decomposition.owned(rank);
      const IndexBox<2> local = decomposition.local(rank, support);
      // Cell i has nodes i and i + 1; wider functions reach one node further to each side.
      const int wider = support == 2 ? 0 : 1;
      for (int d = 0; d < 2; ++d) {
        EXPECT_EQ(local.lower[d], std::max(0, owned.lower[d] - 1 - wider));
        EXPECT_EQ(local.upper[d], std::min(40, owned.upper[d] + 1 + wider + 1));
      }
    }
}

TEST(Decomposition, EqualCutsDifferByOneLayerAtMost)
{
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({31, 8}), {ranks(), 1}, {}, {});
  LocalIndex least = 31, most = 0;
  for (int rank = 0; rank < ranks(); ++rank) {
    least = std::min(least, decomposition.owned(rank).count()[0]);
    most = std::max(most, decomposition.owned(rank).count()[0]);
  }
  EXPECT_LE(most - least, 1);
}

TEST(Decomposition, WeightedCutsBalanceAOneSidedWeight)
{
  const std::vector<double> weights = one_sided(80);
  const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / ranks();
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({80, 8}), {ranks(), 1},
                                       {weights, {}}, {});
  for (int rank = 0; rank < ranks(); ++rank) {
    const IndexBox<2> box = decomposition.owned(rank);
    const double work =
        std::accumulate(weights.begin() + box.lower[0], weights.begin() + box.upper[0], 0.0);
    // Each of the two cuts lies within half of the heaviest layer from where it should.
    EXPECT_NEAR(work, mean, 9.0) << "rank " << rank;
  }
}

TEST(Decomposition, AllTheWorkInOneLayerStillLeavesEveryPartTwoNodes)
{
  std::vector<double> weights(2 * ranks(), 0.0);
  weights.front() = 1000;
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({2 * ranks(), 6}), {ranks(), 1},
                                       {weights, {}}, {});
  for (int rank = 0; rank < ranks(); ++rank) {
    EXPECT_EQ(decomposition.owned(rank).lower[0], 2 * rank);
    EXPECT_EQ(decomposition.owned(rank).upper[0], 2 * rank + 2);
  }
}

TEST(Decomposition, AxisToBeKeptWholeIsNotCutByUpToFourRanks)
{
  if (ranks() > 4) GTEST_SKIP() << "more ranks may cut both axes";
  for (const int axis : {0, 1}) {
    const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({100, 70}), {0, 0}, {}, axis);
    EXPECT_EQ(decomposition.ranks_per_axis()[axis], 1) << "axis " << axis;
    EXPECT_EQ(decomposition.ranks_per_axis()[1 - axis], ranks());
  }
}

TEST(Decomposition, AxisToBeKeptWholeIsCutWhereTheOtherHasTooFewNodes)
{
  const Decomposition<2> decomposition(MPI_COMM_WORLD, grid_of<2>({90, 2}), {0, 0}, {}, 0);
  EXPECT_EQ(decomposition.ranks_per_axis()[0], ranks());
}

TEST(Decomposition, GivenNumberOfRanksPerAxisIsTaken)
{
  const IndexVec<2> wish = ranks() % 2 == 0 ? IndexVec<2>(ranks() / 2, 2) : IndexVec<2>(1, ranks());
  const Decomposition<2> both(MPI_COMM_WORLD, grid_of<2>({30, 30}), wish, {}, {});
  EXPECT_EQ(both.ranks_per_axis(), wish);
  const Decomposition<2> one(MPI_COMM_WORLD, grid_of<2>({30, 30}), {0, wish[1]}, {}, {});
  EXPECT_EQ(one.ranks_per_axis(), wish);
}

/// Every rank refuses with the same words, or none does.
template <int Dim>
void expect_refused(const IndexVec<Dim>& nodes, const IndexVec<Dim>& wish, const char* words)
{
  try {
    const Decomposition<Dim> decomposition(MPI_COMM_WORLD, grid_of<Dim>(nodes), wish, {}, {});
    ADD_FAILURE() << "arranged as " << decomposition.ranks_per_axis().transpose();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(ranks()) + " ranks"));
  }
}

TEST(Decomposition, ArrangementsThatDoNotMakeUpTheRanksAreRefusedEverywhere)
{
  expect_refused<2>({50, 40}, {ranks() + 1, 0}, "x any on a grid of 50 x 40 nodes");
  expect_refused<2>({50, 40}, {ranks(), 2}, "x 2 on a grid of 50 x 40 nodes");
  expect_refused<3>({50, 40, 30}, {1, 1, ranks() + 1}, "Use fewer ranks");
}

TEST(Decomposition, GridWithTooFewNodesIsRefusedEverywhere)
{
  if (ranks() == 1) GTEST_SKIP() << "one rank takes any grid";
  expect_refused<2>({3, 3}, {0, 0}, "any x any on a grid of 3 x 3 nodes");
  expect_refused<2>({2 * ranks() - 1, 3}, {ranks(), 0}, "each needs at least 2 nodes per axis");
  expect_refused<3>({3, 3, 3}, {0, 0, 0}, "3 x 3 x 3 nodes");
}

}  // namespace
}  // namespace mpm
