#include <mpm/core/lane_vector.hpp>
#include <mpm/core/lanes.hpp>

#include <cstdint>
#include <numeric>

#include <gtest/gtest.h>

namespace mpm {
namespace {

std::uintptr_t place(const LaneVector<double>& values)
{
  return reinterpret_cast<std::uintptr_t>(values.data());
}

/// Sizes below, at and above a large page, and not whole pages.
TEST(LaneVector, StartsOnALaneAndLargeOnesOnALargePage)
{
  constexpr std::size_t page = std::size_t(2) << 20;
  for (const std::size_t bytes : {std::size_t(8), page - 8, page, page + 8, 3 * page + 4096}) {
    const LaneVector<double> values(bytes / sizeof(double));
    EXPECT_EQ(place(values) % lane_alignment, 0u) << bytes;
    if (bytes >= page) {
      EXPECT_EQ(place(values) % page, 0u) << bytes;
    }
  }
}

TEST(LaneVector, KeepsItsValuesWhenItGrowsAndIsCopied)
{
  LaneVector<double> values;
  for (int k = 0; k < 600000; ++k) values.push_back(k);
  LaneVector<double> other = values;
  values.clear();
  values.shrink_to_fit();
  EXPECT_EQ(std::accumulate(other.begin(), other.end(), 0.0), 0.5 * 600000 * 599999.0);
}

}  // namespace
}  // namespace mpm
