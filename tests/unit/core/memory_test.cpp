#include <mpm/core/memory.hpp>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace mpm {
namespace {

TEST(Memory, IsAtMostThatOfTheMachineAndOfTheLimitOfTheProcess)
{
  const double machine = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  EXPECT_GT(memory_limit(), 1e6);
  EXPECT_LE(memory_limit(), machine);
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  rlimit less = before;
  less.rlim_cur = rlim_t(machine / 4);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &less), 0);
  const double found = memory_limit();
  setrlimit(RLIMIT_AS, &before);
  EXPECT_LE(found, machine / 4);
}

TEST(Memory, IsWrittenInTheUnitThatFits)
{
  EXPECT_EQ(memory_text(12e3), "12 kB");
  EXPECT_EQ(memory_text(1.26e6), "1.3 MB");
  EXPECT_EQ(memory_text(126e6), "126 MB");
  EXPECT_EQ(memory_text(25.6e9), "25.6 GB");
}

}  // namespace
}  // namespace mpm
