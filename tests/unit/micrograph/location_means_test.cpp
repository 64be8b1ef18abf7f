#include <mpm/micrograph/location_means.hpp>

#include <cstdint>
#include <numeric>

#include <gmock/gmock.h>

namespace mpm::micrograph {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::Pointwise;

// Exact sums, one division: at most one rounding.
constexpr double rounding = 1e-12;

std::vector<double> means_of(const GrayImage& image, int nx, int ny)
{
  return location_means<2>(image, {nx, ny}, {{0, 0}, {nx, ny}});
}

TEST(LocationMeans, OnePixelPerLocationTurnsTheRowsOver)
{
  const GrayImage image{2,
                        2,
                        {10, 20,  //
                         30, 40},
                        {}};
  EXPECT_THAT(means_of(image, 2, 2), ElementsAre(30, 40, 10, 20));
}

TEST(LocationMeans, FourPixelsPerLocationAreAveraged)
{
  const GrayImage image{4,
                        2,
                        {10, 20, 50, 60,  //
                         30, 40, 70, 81},
                        {}};
  EXPECT_THAT(means_of(image, 2, 1), ElementsAre(25, 65.25));
}

TEST(LocationMeans, OneAndAHalfPixelsShareTheMiddlePixel)
{
  // Along x: (a + b/2) / 1.5 and (b/2 + c) / 1.5; along y the same.
  const GrayImage row{3, 1, {30, 60, 120}, {}};
  EXPECT_THAT(means_of(row, 2, 1), ElementsAre(40, 100));
  const GrayImage square{3,
                         3,
                         {0, 0, 0,   //
                          0, 90, 0,  //
                          0, 0, 9},
                         {}};
  // Each quarter has a quarter of the middle pixel out of 2.25 pixels: 10; the last pixel adds 4.
  EXPECT_THAT(means_of(square, 2, 2), Pointwise(DoubleNear(rounding), {10.0, 14.0, 10.0, 10.0}));
}

TEST(LocationMeans, HalfAPixelTakesItsPixelsLevel)
{
  const GrayImage image{2, 1, {10, 200}, {}};
  EXPECT_THAT(means_of(image, 4, 2), ElementsAre(10, 10, 200, 200, 10, 10, 200, 200));
}

TEST(LocationMeans, TwoThirdsOfAPixelStraddleTheMiddle)
{
  const GrayImage image{2, 1, {30, 90}, {}};
  EXPECT_THAT(means_of(image, 3, 1), ElementsAre(30, 60, 90));
}

TEST(LocationMeans, EqualLevelsStayEqualForEveryRatio)
{
  // A mean that should equal the threshold must not fall below it by rounding.
  for (const int pixels : {1, 7, 36, 97})
    for (const int locations : {1, 3, 10, 41, 97, 300}) {
      const GrayImage image{
          pixels, pixels, std::vector<double>(std::size_t(pixels) * pixels, 150), {}};
      EXPECT_THAT(means_of(image, locations, locations), Each(150.0));
    }
}

TEST(LocationMeans, MeanOfTheMeansIsTheMeanOfThePixels)
{
  GrayImage image{23, 17, {}, {}};
  for (int pixel = 0; pixel < 23 * 17; ++pixel) image.gray.push_back(pixel * 37 % 256);
  const double mean = std::accumulate(image.gray.begin(), image.gray.end(), 0.0) / (23 * 17);
  for (const auto [nx, ny] : {std::array{5, 40}, {23, 17}, {60, 3}}) {
    const std::vector<double> means = means_of(image, nx, ny);
    EXPECT_NEAR(std::accumulate(means.begin(), means.end(), 0.0) / (nx * ny), mean, 1e-10);
  }
}

TEST(LocationMeans, OfAPartAreThoseOfTheWhole)
{
  // 2.3 and 0.85 pixels per location, so that parts begin and end within pixels.
  GrayImage image{23, 17, {}, {}};
  for (int pixel = 0; pixel < 23 * 17; ++pixel) image.gray.push_back(pixel * 37 % 256);
  const IndexVec<2> count(10, 20);
  const std::vector<double> whole = means_of(image, 10, 20);
  const IndexBox<2> part{{3, 7}, {8, 19}};
  const std::vector<double> means = location_means(image, count, part);
  ASSERT_EQ(means.size(), std::size_t(part.size()));
  for_each_index(part, [&](const IndexVec<2>& at) {
    EXPECT_EQ(means[std::size_t(number_in(part, at))], whole[std::size_t(at[1] * 10 + at[0])]);
  });
}

TEST(LocationMeans, OfAStackAreOverBoxes)
{
  // Of 5 slices of 4 x 3 pixels over 3 x 2 x 2 locations, against fine subdivisions of both.
  GrayImage stack{4, 3, {}, {}, 5};
  for (int pixel = 0; pixel < 4 * 3 * 5; ++pixel) stack.gray.push_back(pixel * 37 % 256);
  const IndexVec<3> count(3, 2, 2), fine(12, 6, 10);
  const IndexBox<3> whole{{0, 0, 0}, count};
  const std::vector<double> means = location_means(stack, count, whole);
  ASSERT_EQ(means.size(), 12u);
  std::vector<double> expected(12, 0.0);
  for_each_index(IndexBox<3>{{0, 0, 0}, fine}, [&](const IndexVec<3>& at) {
    const int column = at[0] * 4 / 12, from_bottom = at[1] * 3 / 6, slice = at[2] * 5 / 10;
    const int location = (at[2] / 5 * 2 + at[1] / 3) * 3 + at[0] / 4;
    const double share = 12.0 / (12 * 6 * 10);
    expected[std::size_t(location)] +=
        share * stack.gray[std::size_t((slice * 3 + 2 - from_bottom) * 4 + column)];
  });
  EXPECT_THAT(means, Pointwise(DoubleNear(1e-11), expected));

  const IndexBox<3> part{{1, 0, 1}, {3, 2, 2}};
  const std::vector<double> of_part = location_means(stack, count, part);
  std::size_t k = 0;
  for_each_index(part, [&](const IndexVec<3>& at) {
    EXPECT_EQ(of_part[k++], means[std::size_t((at[2] * 2 + at[1]) * 3 + at[0])]);
  });
  EXPECT_EQ(k, of_part.size());
}

}  // namespace
}  // namespace mpm::micrograph
