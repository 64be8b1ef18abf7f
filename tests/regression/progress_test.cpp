// What a program says of its stages, a run of its speed and of the time that is left.
#include <mpm/simulation/long_stage.hpp>
#include <mpm/simulation/progress.hpp>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace mpm {
namespace {

TEST(Progress, OfARunThatGoesOnCountsFromWhereItWentOn)
{
  ::testing::internal::CaptureStdout();
  Progress progress;
  progress.show({.fraction = 0.5, .step = 1000, .particle_steps = 1'000'000'000});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  progress.show({.fraction = 0.75, .step = 1001, .particle_steps = 1'000'010'000});
  const std::string said = ::testing::internal::GetCapturedStdout();
  // Not more than 10,000 in 0.1 s, as much is left as is done: on a slow machine it takes longer.
  double rate = -1;
  const std::size_t at = said.find("  t 0 s  ", said.find("step 1001"));
  ASSERT_NE(at, std::string::npos) << said;
  ASSERT_EQ(std::sscanf(said.c_str() + at, "  t 0 s %lf M particles/s", &rate), 1) << said;
  EXPECT_LE(rate, 0.1);
  EXPECT_GE(rate, 0);
  EXPECT_NE(said.find(" left", at), std::string::npos) << said;
}

TEST(LongStage, SaysWhatItIsAtIfThatTakesLong)
{
  using namespace std::chrono_literals;
  ::testing::internal::CaptureStdout();
  {
    const LongStage stage("reading the picture", 1ms);
    std::this_thread::sleep_for(500ms);
  }
  {
    const LongStage stage("nothing of note", 1h);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "reading the picture ...\n");
}

}  // namespace
}  // namespace mpm
