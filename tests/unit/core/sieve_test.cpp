#include <mpm/core/sieve.hpp>

#include <functional>

#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Behind what is there: the numbers below `end` that `belongs` keeps.
void append_below(int end, const std::function<bool(int)>& belongs, std::vector<int>& kept)
{
  Sieve sieve(kept);
  for (int k = 0; k < end; ++k) {
    sieve.item() = k;
    sieve.keep(belongs(k));
  }
}

TEST(Sieve, AppendsWhatIsKeptInItsOrderHoweverMany)
{
  const auto every_third = [](int k) { return k % 3 == 1; };
  for (const int end : {0, 1, 2, 190, 191, 192, 193, 1000}) {  // 64 are kept of 191
    std::vector<int> kept{-1}, expected{-1};
    for (int k = 1; k < end; k += 3) expected.push_back(k);
    append_below(end, every_third, kept);
    EXPECT_EQ(kept, expected) << "of " << end;
  }
}

TEST(Sieve, KeepsAllOrNothing)
{
  std::vector<int> all, none;
  append_below(
      128, [](int) { return true; }, all);
  append_below(
      128, [](int) { return false; }, none);
  EXPECT_EQ(all.size(), 128u);
  EXPECT_EQ(all.back(), 127);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace mpm
