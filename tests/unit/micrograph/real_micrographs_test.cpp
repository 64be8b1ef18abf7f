/// Micrographs of real wood, where they are at hand: in the directory named by MPM_MICROGRAPHS,
/// else beside the project. Expected figures are those noted with the pictures (wall >= threshold).

#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/threshold.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace mpm::micrograph {
namespace {

struct Picture {
  const char* file;
  int width, height;
  double otsu, at_otsu, at_128, at_150;
};

void PrintTo(const Picture& picture, std::ostream* out)
{
  *out << picture.file;
}

class RealMicrograph : public testing::TestWithParam<Picture> {};

TEST_P(RealMicrograph, HasTheThresholdAndWallFractionNotedWithIt)
{
  const char* folder = std::getenv("MPM_MICROGRAPHS");
  const auto file = std::filesystem::path(folder ? folder : MPM_MICROGRAPHS) / GetParam().file;
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is not there; set MPM_MICROGRAPHS to the folder that holds "
                 << GetParam().file << ".";
  const GrayImage image = read_image(file);
  EXPECT_EQ(image.width, GetParam().width);
  EXPECT_EQ(image.height, GetParam().height);
  const auto wall_fraction = [&](double threshold) {
    return double(std::ranges::count_if(image.gray, [=](double g) { return g >= threshold; })) /
           double(image.gray.size());
  };
  EXPECT_EQ(otsu_threshold(image.gray), GetParam().otsu);
  constexpr double printed = 0.0006;  // three digits are noted
  EXPECT_NEAR(wall_fraction(GetParam().otsu), GetParam().at_otsu, printed);
  EXPECT_NEAR(wall_fraction(128), GetParam().at_128, printed);
  EXPECT_NEAR(wall_fraction(150), GetParam().at_150, printed);
}

INSTANTIATE_TEST_SUITE_P(
    Wood, RealMicrograph,
    testing::Values(
        Picture{"spruce_sem/spruce_ring_boundary_x4.bmp", 748, 328, 99, 0.613, 0.523, 0.396},
        Picture{"spruce_sem/spruce_earlywood_x4.bmp", 328, 1144, 96, 0.505, 0.393, 0.288},
        Picture{"hardwood/lomatia_arborescens_621x418.bmp", 621, 418, 108, 0.566, 0.524, 0.469},
        Picture{"hardwood/acer_davidii_460x695.bmp", 460, 695, 110, 0.619, 0.535, 0.407}));

TEST(RealMicrographNative, SpruceRingBoundaryHasItsOwnOtsuThreshold)
{
  const char* folder = std::getenv("MPM_MICROGRAPHS");
  const auto file = std::filesystem::path(folder ? folder : MPM_MICROGRAPHS) /
                    "spruce_sem/spruce_ring_boundary_native.bmp";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there; set MPM_MICROGRAPHS.";
  const GrayImage image = read_image(file);
  EXPECT_EQ(image.width, 187);
  EXPECT_EQ(image.height, 82);
  EXPECT_EQ(otsu_threshold(image.gray), 100);
  const auto bright = std::ranges::count_if(image.gray, [](double g) { return g >= 128; });
  EXPECT_NEAR(double(bright) / double(image.gray.size()), 0.525, 0.0006);
}

}  // namespace
}  // namespace mpm::micrograph
