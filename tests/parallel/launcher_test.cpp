/// What ranks know of their launcher and of each other's places; the limit of waiting.

#include <mpm/parallel/launcher.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/self_test.hpp>

#include <chrono>
#include <cstdlib>

#include <gmock/gmock.h>
#include <unistd.h>

namespace mpm {
namespace {

TEST(Launcher, HasStartedTheRanksOfThisWorld)
{
  const std::optional<Launched> found = launched();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->ranks, ranks_of(MPI_COMM_WORLD));
  EXPECT_EQ(found->rank, rank_of(MPI_COMM_WORLD));
}

TEST(Launcher, OfASlurmStepIsSrunUnlessAnMpirunWithinItSaysMore)
{
  setenv("SLURM_STEP_NUM_TASKS", "77", 1);
  setenv("SLURM_PROCID", "7", 1);
  EXPECT_EQ(launched()->ranks, ranks_of(MPI_COMM_WORLD));
  const std::string own = std::getenv("OMPI_COMM_WORLD_SIZE");
  unsetenv("OMPI_COMM_WORLD_SIZE");
  EXPECT_EQ(launched()->ranks, 77);
  EXPECT_EQ(launched()->rank, 7);
  setenv("OMPI_COMM_WORLD_SIZE", own.c_str(), 1);
}

TEST(Launcher, RanksOfOneMachineAreOnOneNode)
{
  const Places places = places_of(MPI_COMM_WORLD);
  EXPECT_EQ(places.nodes, 1);
  EXPECT_LT(places.sharing, ranks_of(MPI_COMM_WORLD));
}

TEST(SelfTestLimit, EndsAWaitThatDoesNotEndAndNamesIt)
{
  if (rank_of(MPI_COMM_WORLD) > 0) return;  // a process of its own waits
  EXPECT_EXIT(
      {
        SelfTestLimit limit(100, "start");
        limit.begin("messages");
        alarm(1);
        for (;;) pause();
      },
      testing::ExitedWithCode(1), "no end of \"messages\" within 100 s");
}

}  // namespace
}  // namespace mpm
