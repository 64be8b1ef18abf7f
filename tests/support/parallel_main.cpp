/// main of every test that runs on several ranks: rank 0 prints, any rank's failure fails the test
/// everywhere, and the messages of other ranks carry their number.

#include <mpm/parallel/session.hpp>

#include <cstdio>

#include <gtest/gtest.h>

namespace {

class OtherRanksFailures : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override
  {
    if (result.failed())
      std::fprintf(stderr, "rank %d: %s:%d: %s\n", mpm::rank_of(MPI_COMM_WORLD),
                   result.file_name() ? result.file_name() : "?", result.line_number(),
                   result.summary());
  }
};

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  const mpm::Session session(argc, argv, {});
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (mpm::rank_of(MPI_COMM_WORLD) != 0) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new OtherRanksFailures);
  }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return failed;
}
