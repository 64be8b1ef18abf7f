#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>

#include <gmock/gmock.h>

namespace mpm {
namespace {

using ::testing::StrEq;

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}
int rank()
{
  return rank_of(MPI_COMM_WORLD);
}

/// Throws `error` on the ranks from `first` on; each rank names itself.
template <class Error>
void expect_the_lowest_ranks_error(int first)
{
  try {
    agree(MPI_COMM_WORLD, [&] {
      if (rank() >= first) throw Error("rank " + std::to_string(rank()) + " failed");
    });
    ADD_FAILURE() << "nothing was thrown on rank " << rank();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), StrEq("rank " + std::to_string(first) + " failed"));
  }
}

TEST(Agreement, WithoutAFailureNobodyThrows)
{
  int calls = 0;
  EXPECT_NO_THROW(agree(MPI_COMM_WORLD, [&] { ++calls; }));
  EXPECT_EQ(calls, 1);
}

TEST(Agreement, EveryRankThrowsTheKindAndWordsOfTheLowestThatFailed)
{
  for (int first = 0; first < ranks(); ++first) {
    expect_the_lowest_ranks_error<InputError>(first);
    expect_the_lowest_ranks_error<NumericalError>(first);
    expect_the_lowest_ranks_error<FileError>(first);
    expect_the_lowest_ranks_error<std::runtime_error>(first);
  }
}

TEST(Agreement, DifferentFailuresBecomeThatOfTheLowestRank)
{
  EXPECT_THROW(agree(MPI_COMM_WORLD,
                     [] {
                       if (rank() == 0) throw FileError("disk");
                       throw NumericalError("number");
                     }),
               FileError);
}

TEST(Agreement, MessagesOfSeveralLinesAndNoneStayWhole)
{
  const std::string lines = "first problem\nsecond problem \u00b5m";
  try {
    agree(MPI_COMM_WORLD, [&] {
      if (rank() == ranks() - 1) throw InputError(lines);
    });
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), lines);
  }
  try {
    agree(MPI_COMM_WORLD, [] { throw FileError(""); });
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), StrEq(""));
  }
}

TEST(Endings, AreWaitedForAsLongAsAskedFor)
{
  MPI_Comm together, apart;
  MPI_Comm_dup(MPI_COMM_WORLD, &together);
  MPI_Comm_dup(MPI_COMM_WORLD, &apart);
  EXPECT_TRUE(all_arrive(together, 60));
  // Rank 0 comes when the others have given up.
  if (rank() > 0) {
    EXPECT_FALSE(all_arrive(apart, 0.05));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) {
    EXPECT_TRUE(all_arrive(apart, 60));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Comm_free(&together);  // the other one's barrier is still under way on some ranks
}

TEST(SumsOverRanks, GiveEveryRankTheSame)
{
  std::vector<double> values{1.5, double(rank())};
  sum_over_ranks(MPI_COMM_WORLD, values);
  EXPECT_EQ(values[0], 1.5 * ranks());
  EXPECT_EQ(values[1], 0.5 * ranks() * (ranks() - 1));

  std::vector<GlobalIndex> counts{GlobalIndex{1} << 40};
  sum_over_ranks(MPI_COMM_WORLD, counts);
  EXPECT_EQ(counts[0], (GlobalIndex{1} << 40) * ranks());

  EXPECT_EQ(largest_over_ranks(MPI_COMM_WORLD, -double(rank())), 0);
}

}  // namespace
}  // namespace mpm
