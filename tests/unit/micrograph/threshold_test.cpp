#include <mpm/micrograph/threshold.hpp>

#include <algorithm>

#include "image_files.hpp"
#include <gmock/gmock.h>

namespace mpm::micrograph::test {
namespace {

using scene::Wall;

double wall_fraction(const std::vector<double>& means, double threshold, Wall wall)
{
  const auto walls =
      std::ranges::count_if(means, [&](double mean) { return is_wall(mean, threshold, wall); });
  return double(walls) / double(means.size());
}

TEST(Threshold, AMeanEqualToItIsBrightWallAndNotDarkWall)
{
  EXPECT_TRUE(is_wall(150, 150, Wall::bright));
  EXPECT_FALSE(is_wall(149.999, 150, Wall::bright));
  EXPECT_FALSE(is_wall(150, 150, Wall::dark));
  EXPECT_TRUE(is_wall(149.999, 150, Wall::dark));
}

TEST(OtsuThreshold, TwoLevelsArePartedInTheMiddle)
{
  EXPECT_EQ(otsu_threshold(std::vector<double>{50, 50, 50, 200}), 125);  // of 51 ... 200
  EXPECT_EQ(otsu_threshold(std::vector<double>{0, 1}), 1);
  EXPECT_EQ(otsu_threshold(std::vector<double>{254, 255}), 255);
}

double variance_between(const std::vector<double>& gray, double threshold)
{
  double below = 0, below_sum = 0, above = 0, above_sum = 0;
  for (const double level : gray) {
    (level < threshold ? below : above) += 1;
    (level < threshold ? below_sum : above_sum) += level;
  }
  const double difference = below_sum / below - above_sum / above;
  return below * above * difference * difference;
}

/// Two triangular humps of unlike weight; `unit`: gray of one level of the 256.
std::vector<double> two_humps(double unit)
{
  std::vector<double> gray;
  for (int level = 0; level < 256; ++level) {
    const int count =
        std::max(0, 40 - std::abs(level - 70)) + std::max(0, 60 - std::abs(level - 160)) / 3;
    gray.insert(gray.end(), std::size_t(count), level * unit);
  }
  return gray;
}

TEST(OtsuThreshold, MaximizesTheVarianceBetweenTheClasses)
{
  // Compared with trying every threshold on the levels. A unit of 1/257: 8 bits that a file of 16
  // bits holds as they were; 16/257: 12 bits; the last one as weighted colours have it.
  for (const double unit : {1.0, 1.0 / 257, 16.0 / 257, 0.587}) {
    const std::vector<double> gray = two_humps(unit);
    const double best = variance_between(gray, otsu_threshold(gray));
    for (int threshold = 40; threshold < 200; ++threshold)
      EXPECT_LE(variance_between(gray, threshold * unit), best * (1 + 1e-12)) << unit;
  }
}

TEST(OtsuThreshold, PicturesOfSixteenBitsArePartedAsThoseOfEight)
{
  const double whole = otsu_threshold(two_humps(1));
  EXPECT_EQ(otsu_threshold(two_humps(1.0 / 257)), whole / 257);
  EXPECT_EQ(otsu_threshold(std::vector<double>{3.0 / 257, 4.0 / 257, 4.0 / 257}), 4.0 / 257);
}

TEST(OtsuThreshold, ImageOfOneLevelIsRefused)
{
  EXPECT_THAT(message_of([] { otsu_threshold(std::vector<double>(9, 80.0)); }),
              testing::StartsWith("specimen.threshold is otsu, but the image has a single gray"));
}

TEST(DensityThreshold, HitsEveryTargetWithinHalfALocation)
{
  std::vector<double> means;  // all different
  for (int i = 0; i < 1000; ++i) means.push_back(i * 619 % 1000 * 0.25);
  for (const Wall wall : {Wall::bright, Wall::dark})
    for (const double target : {0.001, 0.25, 0.4, 0.6074, 0.9996}) {
      const double threshold = threshold_for_density(means, target, wall, {});
      EXPECT_LE(std::abs(wall_fraction(means, threshold, wall) - target), 0.0005 * (1 + 1e-9))
          << target;
    }
}

TEST(DensityThreshold, TakesTheNearerSideOfATie)
{
  const std::vector<double> means{10, 10, 10, 10, 10, 10, 200, 200, 200, 200};
  EXPECT_EQ(threshold_for_density(means, 0.5, Wall::bright, {}), 105);  // 0.4 rather than 1
  EXPECT_EQ(threshold_for_density(means, 0.5, Wall::dark, {}), 105);    // 0.6 rather than 0
  EXPECT_EQ(threshold_for_density(means, 0.8, Wall::bright, {}), 10);   // 1 rather than 0.4
  const double everything = threshold_for_density(means, 0.9, Wall::dark, {});
  EXPECT_EQ(wall_fraction(means, everything, Wall::dark), 1);
}

TEST(DensityThreshold, LiesHalfwayBetweenTheMeansItParts)
{
  EXPECT_EQ(threshold_for_density(std::vector<double>{0, 10, 20, 30}, 0.5, Wall::bright, {}), 15);
}

TEST(DensityThreshold, TargetsOutsideZeroToOneAreRefused)
{
  for (const double target : {0.0, 1.0, -0.1, 40.0})
    EXPECT_THAT(message_of([&] {
                  threshold_for_density(std::vector<double>{1, 2}, target, Wall::bright, {});
                }),
                testing::EndsWith("(must lie between 0 and 1, both excluded)."));
}

}  // namespace
}  // namespace mpm::micrograph::test
