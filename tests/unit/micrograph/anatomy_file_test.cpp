#include <mpm/core/error.hpp>
#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/anatomy_parameters.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "drawn_wood.hpp"
#include <gmock/gmock.h>
#include <unistd.h>

namespace {

using namespace mpm::micrograph::anatomy;
using mpm::FileError;
using mpm::InputError;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A parameter file in a folder that goes away with the test.
class ParameterFile : public ::testing::Test {
 protected:
  ParameterFile()
      : folder_(std::filesystem::temp_directory_path() /
                ("anatomy_test_" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(folder_);
  }
  ~ParameterFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path written(const std::string& text) const
  {
    std::ofstream(folder_ / "wood.yaml") << text;
    return folder_ / "wood.yaml";
  }

  std::string error_of(const std::string& text) const
  {
    try {
      const Parameters wood = read_parameters(written(text));
      draw(wood, wood.seed);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

const std::string small = "picture: {width_px: 64, height_px: 48, width: 200, height: 150}\n";

TEST_F(ParameterFile, WithoutDensityKeepsTheWallsItGives)
{
  const Parameters wood = read_parameters(written(small + "seed: 7\n"));
  EXPECT_EQ(wood.seed, 7U);
  const Drawing picture = draw(wood, wood.seed);
  EXPECT_EQ(picture.gray.size(), 64U * 48U);
  EXPECT_TRUE(picture.wall_scale.empty());
}

TEST_F(ParameterFile, ThickerWallsMakeDenserWood)
{
  const auto density = [&](const std::string& wall) {
    const Parameters wood =
        read_parameters(written(small + "files: {earlywood: {wall: " + wall + "}}\n"));
    return Walls(draw(wood, 1), 64, 48).density();
  };
  const double thin = density("2"), medium = density("4"), thick = density("6");
  EXPECT_LT(thin + 0.1, medium);
  EXPECT_LT(medium + 0.1, thick);
}

TEST_F(ParameterFile, FilledRaysAreSolidBandsAcrossTheSection)
{
  // Rows of the picture, pixel by pixel, that hold nothing but wall.
  const auto solid_rows = [&](const std::string& rays) {
    const Parameters wood = read_parameters(
        written("picture: {width_px: 100, height_px: 150, width: 100, height: 150}\n"
                "irregularity: {wave: 0}\ngray: {noise: 0, shading: 0}\nrays: {" +
                rays + "}\n"));
    const Walls pixels(draw(wood, 1), 100, 150);
    int rows = 0;
    for (int j = 0; j < pixels.ny; ++j) {
      const auto row = pixels.wall.begin() + std::ptrdiff_t(j) * pixels.nx;
      rows += std::all_of(row, row + pixels.nx, [](bool wall) { return wall; });
    }
    return rows;
  };
  const std::string ray = "spacing: 90, cell_height: 16, rows: 1, filled: ";  // two of them
  const int open = solid_rows(ray + "0");
  EXPECT_EQ(open, solid_rows("spacing: 90, cell_height: 16, rows: 1"));
  EXPECT_GT(solid_rows(ray + "0.3"), open);
  EXPECT_GE(solid_rows(ray + "1"), open + 2 * (16 - 2 * 1.8));  // walls of 1.8 um about each lumen
}

TEST_F(ParameterFile, UnknownKeyIsNamedWithPlaceAndNearestKey)
{
  EXPECT_THAT(error_of(small + "files:\n  tangental_pitch: 30\n"),
              HasSubstr("wood.yaml:3:3: unknown key 'tangental_pitch' "
                        "(did you mean 'tangential_pitch'?)"));
  EXPECT_THAT(error_of(small + "vessel: {}\n"), HasSubstr("(did you mean 'vessels'?)"));
}

TEST_F(ParameterFile, ValueOutOfRangeIsNamedWithItsBounds)
{
  EXPECT_THAT(error_of(small + "rays: {rows: 21}\n"),
              HasSubstr("wood.yaml:2:14: rays.rows is 21 (must be from 1 to 20)."));
  EXPECT_THAT(error_of(small + "files: {latewood: {wall: .nan}}\n"),
              HasSubstr("files.latewood.wall is .nan (must be from 0.1 to 100)."));
}

TEST_F(ParameterFile, ValueOfTheWrongKindIsNamed)
{
  EXPECT_THAT(error_of(small + "rays: {rows: 1.5}\n"),
              HasSubstr("rays.rows is 1.5 (must be a whole number)"));
  EXPECT_THAT(error_of(small + "gray: {wall: [1, 2]}\n"),
              HasSubstr("gray.wall is not a single value"));
  EXPECT_THAT(error_of(small + "gray: 3\n"), HasSubstr("gray holds no keys"));
  EXPECT_THAT(error_of(small + "seed: one\n"), HasSubstr("seed must be a whole number"));
  EXPECT_THAT(error_of(small + "resin_canals: {x: 1}\n"), HasSubstr("resin_canals is not a list"));
}

TEST_F(ParameterFile, AllProblemsAreReportedAtOnce)
{
  EXPECT_THAT(
      error_of("gray: {blur: 99}\nsed: 1\n"),
      AllOf(HasSubstr("gray.blur is 99"), HasSubstr("unknown key 'sed' (did you mean 'seed'?)"),
            HasSubstr("picture is missing")));
}

TEST_F(ParameterFile, DensityWindowsMustCoverTheWidthOnce)
{
  const std::string message = "density.windows must follow each other from 0 to 1 without gaps.";
  const std::string half = "density: {windows: [{from: 0, to: 0.5}";
  EXPECT_THAT(error_of(small + half + "]}\n"), HasSubstr(message));
  EXPECT_THAT(error_of(small + half + ", {from: 0.6, to: 1}]}\n"), HasSubstr(message));
  EXPECT_THAT(error_of(small + half + ", {from: 0.4, to: 1}]}\n"), HasSubstr(message));
  EXPECT_THAT(error_of(small + "density: {threshold: 150}\n"), HasSubstr(message));
}

TEST_F(ParameterFile, DensityOutOfReachSaysWhatTheWallsReach)
{
  EXPECT_THAT(error_of(small + "density: {lattice_x: 64, lattice_y: 48, "
                               "windows: [{from: 0, to: 1, relative_density: 0.02}]}\n"),
              AllOf(HasSubstr("density.windows[0].relative_density is 0.02 (walls scaled by"),
                    HasSubstr("Change the wall or pitch")));
}

TEST_F(ParameterFile, ValuesThatContradictEachOtherAreNamed)
{
  EXPECT_THAT(error_of(small + "vessels: {smallest: 50, largest: 30}\n"),
              HasSubstr("vessels.largest is 30 (below vessels.smallest, 50)."));
  EXPECT_THAT(
      error_of(small + "gray: {wall: 140}\ndensity: {windows: [{from: 0, to: 1}]}\n"),
      HasSubstr("density.threshold is 150 (must lie between gray.lumen, 48, and gray.wall, 140)."));
}

TEST_F(ParameterFile, BrokenYamlAndMissingFileAreDifferentErrors)
{
  EXPECT_THAT(error_of("picture: {width_px: [\n"), HasSubstr("(not valid YAML)"));
  EXPECT_THROW(read_parameters(folder_ / "none.yaml"), FileError);
}

TEST_F(ParameterFile, PictureThatCannotBeWrittenIsAFileError)
{
  const Parameters wood = read_parameters(written(small));
  const Drawing picture = draw(wood, 1);
  EXPECT_THROW(write_bmp(picture, wood.picture, folder_ / "none" / "wood.bmp"), FileError);
  EXPECT_THROW(write_png(picture, folder_ / "none" / "wood.png"), FileError);
  EXPECT_THROW(write_png(picture, "/dev/full"), FileError);  // as a full disk is
  write_bmp(picture, wood.picture, folder_ / "wood.bmp");
  EXPECT_EQ(bytes_of(folder_ / "wood.bmp"), bmp_bytes(picture, wood.picture));
  write_png(picture, folder_ / "wood.png");
  EXPECT_THAT(text_of(folder_ / "wood.png"), HasSubstr("IHDR"));
}

TEST(Bmp, RowsArePaddedAndStoredFromTheBottom)
{
  const Drawing picture{3, 2, {10, 11, 12, 20, 21, 22}, {}, {}, {}};
  const std::vector<std::uint8_t> bytes = bmp_bytes(picture, {3, 2, 3, 2});
  ASSERT_EQ(bytes.size(), 14U + 40U + 1024U + 8U);
  const std::vector<std::uint8_t> pixels(bytes.end() - 8, bytes.end());
  EXPECT_THAT(pixels, ::testing::ElementsAre(20, 21, 22, 0, 10, 11, 12, 0));
  EXPECT_EQ(bytes[38] + 256 * bytes[39] + 65536 * bytes[40], 1000000);  // pixels per metre
}

TEST(AnatomyPage, HoldsTheKeyTableAsTheReaderKnowsIt)
{
  EXPECT_THAT(text_of(std::filesystem::path(MPM_DOCS_DIR) / "anatomy.md"), HasSubstr(key_table()));
}

}  // namespace
