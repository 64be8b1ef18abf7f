#include <mpm/analysis/sampled_curve.hpp>
#include <mpm/analysis/straight_line.hpp>

#include <algorithm>
#include <vector>

#include <gmock/gmock.h>

namespace mpm::analysis {
namespace {

TEST(StraightLine, IsFoundExactlyAndNotForcedThroughZero)
{
  const std::vector<double> x{0, 1, 2, 5};
  const std::vector<double> y{4, 7, 10, 19};
  const auto line = fit_line(x, y);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope, 3, 1e-14);  // rounding of four sums
  EXPECT_NEAR(line->intercept, 4, 1e-13);
}

TEST(StraightLine, NeedsTwoDifferentPlaces)
{
  EXPECT_FALSE(fit_line(std::vector{1.0}, std::vector{2.0}));
  EXPECT_FALSE(fit_line(std::vector{1.0, 1.0}, std::vector{2.0, 3.0}));
  EXPECT_FALSE(fit_line({}, {}));
}

TEST(StraightLine, TwoLinesMeetUnlessParallel)
{
  EXPECT_DOUBLE_EQ(meeting_point({1, 2}, {4, 1}).value(), 3);
  EXPECT_FALSE(meeting_point({1, 2}, {4, 2}));
}

TEST(StraightLine, KneeOfTwoLinesIsFoundWithBothSlopes)
{
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= 200; ++i) {
    x.push_back(0.1 * i / 200);
    y.push_back(2 + 30 * std::min(x.back(), 0.025) + 4 * std::max(x.back() - 0.025, 0.0));
  }
  const auto knee = fit_knee(x, y, 0.003, 0.09);
  ASSERT_TRUE(knee);
  EXPECT_NEAR(knee->position, 0.025, 0.087 / 350);  // a step of the scan
  EXPECT_NEAR(knee->slope_before, 30, 0.3);         // what that step does to the slopes
  EXPECT_NEAR(knee->slope_after, 4, 0.1);
  EXPECT_GT(knee->gain, 0.999);
}

TEST(SampledCurve, BinsHoldMeansAndEmptyBinsDoNotExist)
{
  const SampledCurve curve{{0.1, 0.3, 2.5}, {1, 3, 8}};
  const SampledCurve binned = bin_average(curve, 3, 3);
  EXPECT_THAT(binned.strain, ::testing::ElementsAre(::testing::DoubleEq(0.2), 2.5));
  EXPECT_THAT(binned.stress, ::testing::ElementsAre(2, 8));
}

TEST(SampledCurve, UnloadingAndStartUpAreLeftOut)
{
  const std::vector<double> strain{0.0, 0.1, 0.2, 0.3, 0.2, 0.1};
  const std::vector<double> stress{0, 1, 2, 3, -5, -6};
  const SampledCurve curve = loading_part(strain, stress, 0.1);
  EXPECT_THAT(curve.strain, ::testing::ElementsAre(0.1, 0.2, 0.3));
  EXPECT_THAT(curve.stress, ::testing::ElementsAre(1, 2, 3));
}

TEST(SampledCurve, ResamplesRepeatInEveryProgramAndKeepAStraightLineAsItIs)
{
  SampledCurve straight;
  for (int i = 0; i < 500; ++i) {
    straight.strain.push_back(0.001 * i);
    straight.stress.push_back(5 + 2 * straight.strain.back());
  }
  const SampledCurve again = BlockBootstrap(straight, 0.02).resample();
  for (std::size_t i = 0; i < again.stress.size(); ++i)
    ASSERT_NEAR(again.stress[i], straight.stress[i], 1e-12);  // nothing but rounding to rearrange

  SampledCurve noisy = straight;
  for (std::size_t i = 0; i < noisy.stress.size(); ++i) noisy.stress[i] += i % 7 * 0.1;
  const std::vector<double> first = BlockBootstrap(noisy, 0.02).resample().stress;
  EXPECT_EQ(first, BlockBootstrap(noisy, 0.02).resample().stress);
  EXPECT_NE(first, noisy.stress);
}

}  // namespace
}  // namespace mpm::analysis
