/// METIS on blocks of cells: balance, cut, and the same answer on every rank.

#include <mpm/core/error.hpp>
#include <mpm/parallel/block_partition.hpp>
#include <mpm/parallel/session.hpp>

#include <numeric>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// Work in the left half only.
BlockWork<2> one_sided(LocalIndex nx, LocalIndex ny)
{
  BlockWork<2> blocks{IndexVec<2>(nx, ny), 4, {}};
  for (LocalIndex j = 0; j < ny; ++j)
    for (LocalIndex i = 0; i < nx; ++i) blocks.work.push_back(i < nx / 2 ? 64 : 0);
  return blocks;
}

double heaviest_over_mean(const BlockWork<2>& blocks, const BlockPartition& partition, int ranks)
{
  std::vector<double> load(ranks, 0.0);
  for (std::size_t b = 0; b < blocks.work.size(); ++b) load[partition.rank[b]] += blocks.work[b];
  return *std::max_element(load.begin(), load.end()) * ranks /
         std::accumulate(load.begin(), load.end(), 0.0);
}

TEST(BlockPartition, BalancesWorkThatFillsHalfOfTheGrid)
{
  const BlockWork<2> blocks = one_sided(40, 24);
  for (const int ranks : {2, 3, 4, 7, 16}) {
    const BlockPartition partition = partition_blocks(blocks, ranks);
    ASSERT_EQ(partition.rank.size(), blocks.work.size());
    EXPECT_DOUBLE_EQ(partition.imbalance, heaviest_over_mean(blocks, partition, ranks));
    // 480 blocks of equal work: one block more than the mean of 30 is 3 %.
    EXPECT_LT(partition.imbalance, 1.05) << ranks << " ranks";
  }
}

TEST(BlockPartition, TwoRanksShareAboutOneRowOfNodes)
{
  BlockWork<2> blocks{IndexVec<2>(20, 10), 4, std::vector<double>(200, 16)};
  const BlockPartition partition = partition_blocks(blocks, 2);
  // The best cut crosses the short way: 10 blocks of 4 nodes; METIS may need a step in it.
  EXPECT_GE(partition.cut_nodes, 40);
  EXPECT_LE(partition.cut_nodes, 60);
}

TEST(BlockPartition, OneRankOwnsEverythingAndCutsNothing)
{
  const BlockPartition partition = partition_blocks(one_sided(8, 8), 1);
  EXPECT_EQ(partition.cut_nodes, 0);
  EXPECT_DOUBLE_EQ(partition.imbalance, 1.0);
  for (const int rank : partition.rank) EXPECT_EQ(rank, 0);
}

TEST(BlockPartition, WorksOnBlocksInSpace)
{
  BlockWork<3> blocks{IndexVec<3>(8, 8, 8), 4, std::vector<double>(512, 8)};
  const BlockPartition partition = partition_blocks(blocks, 8);
  EXPECT_LT(partition.imbalance, 1.05);
  // Eight cubes of 4 x 4 x 4 blocks cut 3 planes of 64 faces with 16 nodes; half as much again
  // is what a partitioner that does not know of cubes may need.
  EXPECT_GE(partition.cut_nodes, 3 * 64 * 16 * 9 / 10);
  EXPECT_LE(partition.cut_nodes, 3 * 64 * 16 * 3 / 2);
}

TEST(BlockPartition, MoreRanksThanBlocksIsTheUsersMistake)
{
  EXPECT_THROW(partition_blocks(one_sided(2, 1), 3), InputError);
}

TEST(BlockPartition, IsTheSameOnEveryRank)
{
  const BlockPartition partition = partition_blocks(one_sided(17, 13), 5);
  std::vector<double> sum(partition.rank.begin(), partition.rank.end());
  sum_over_ranks(MPI_COMM_WORLD, sum);
  for (std::size_t b = 0; b < sum.size(); ++b)
    EXPECT_EQ(sum[b], double(partition.rank[b]) * ranks_of(MPI_COMM_WORLD));
}

}  // namespace
}  // namespace mpm
