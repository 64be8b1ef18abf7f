#include <mpm/core/recent_least.hpp>

#include <gtest/gtest.h>

namespace mpm {
namespace {

TEST(RecentLeast, IsZeroWithoutValues)
{
  RecentLeast cost;
  EXPECT_EQ(cost.value(), 0.0);
  cost.add(3.0);
  EXPECT_EQ(cost.value(), 3.0);
  cost.clear();
  EXPECT_EQ(cost.value(), 0.0);
}

TEST(RecentLeast, PassesOverDisturbancesButForgets)
{
  RecentLeast cost;
  for (const double value : {2.0, 9.0, 4.0}) cost.add(value);
  EXPECT_EQ(cost.value(), 2.0);
  for (int k = 0; k < 29; ++k) cost.add(5.0);
  EXPECT_EQ(cost.value(), 2.0);  // the oldest of 32
  cost.add(5.0);
  EXPECT_EQ(cost.value(), 4.0);
  for (int k = 0; k < 32; ++k) cost.add(6.0);
  EXPECT_EQ(cost.value(), 6.0);  // what lasts is believed
}

}  // namespace
}  // namespace mpm
