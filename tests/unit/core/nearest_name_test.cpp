#include <mpm/core/bound.hpp>
#include <mpm/core/nearest_name.hpp>

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const std::vector<std::string> keys{"density", "youngs_modulus", "yield_stress"};

TEST(EditDistance, CountsInsertRemoveReplaceAndSwapAsOneEach)
{
  EXPECT_EQ(edit_distance("density", "density"), 0);
  EXPECT_EQ(edit_distance("densty", "density"), 1);
  EXPECT_EQ(edit_distance("densiity", "density"), 1);
  EXPECT_EQ(edit_distance("dansity", "density"), 1);
  EXPECT_EQ(edit_distance("denisty", "density"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(EditDistance, IgnoresCase)
{
  EXPECT_EQ(edit_distance("MPA", "MPa"), 0);
}

TEST(NearestName, FindsAMisspeltKey)
{
  EXPECT_EQ(nearest_name("youngs_modulas", keys), "youngs_modulus");
  EXPECT_EQ(nearest_name("yeild_stress", keys), "yield_stress");
}

TEST(NearestName, StaysSilentWhenMoreThanAThirdDiffers)
{
  EXPECT_EQ(nearest_name("colour", keys), std::nullopt);
  EXPECT_EQ(suggestion("colour", keys), "known: density, youngs_modulus, yield_stress");
}

TEST(Bound, NamesTheEndThatIsBroken)
{
  EXPECT_EQ(between(-1, 0.5).violation(0.5), "must be below 0.5");
  EXPECT_EQ(between(-1, 0.5).violation(-1), "must be above -1");
  EXPECT_EQ(from_to(1, 8).violation(9), "must be at most 8");
  EXPECT_EQ(from_to(1, 8).violation(0), "must be at least 1");
  EXPECT_EQ(from_to(1, 8).violation(8), std::nullopt);
  EXPECT_EQ(between(-1, 0.5).text(), "above -1 and below 0.5");
}

}  // namespace
}  // namespace mpm
