#include <mpm/core/error.hpp>
#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/anatomy_parameters.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace {

using namespace mpm::micrograph::anatomy;
using mpm::FileError;
using mpm::InputError;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::filesystem::path wood_file(const std::string& name)
{
  return std::filesystem::path(MPM_INPUTS_DIR) / "wood" / name;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string text_of(const std::filesystem::path& file)
{
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Lattice of wall (true) and lumen: area-weighted mean gray >= 150, straight from the definition.
struct Walls {
  int nx, ny;
  std::vector<bool> wall;

  Walls(const Drawing& picture, int columns, int rows) : nx(columns), ny(rows)
  {
    const double sx = double(picture.width) / nx, sy = double(picture.height) / ny;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        double sum = 0, area = 0;
        for (int q = int(j * sy); q < std::min(picture.height, int((j + 1) * sy) + 1); ++q)
          for (int p = int(i * sx); p < std::min(picture.width, int((i + 1) * sx) + 1); ++p) {
            const double x = std::min((i + 1) * sx, p + 1.0) - std::max(i * sx, double(p));
            const double y = std::min((j + 1) * sy, q + 1.0) - std::max(j * sy, double(q));
            if (x <= 0 || y <= 0) continue;
            sum += x * y * picture(p, q);
            area += x * y;
          }
        wall.push_back(sum / area >= 150);
      }
  }

  double density(double from = 0, double to = 1) const
  {
    long filled = 0, all = 0;
    for (int j = 0; j < ny; ++j)
      for (int i = int(std::lround(from * nx)); i < int(std::lround(to * nx)); ++i) {
        filled += wall[std::size_t(j) * nx + i];
        ++all;
      }
    return double(filled) / all;
  }

  /// Number of the edge-connected piece that each location belongs to.
  std::vector<int> pieces() const
  {
    std::vector<int> piece(wall.size(), -1);
    int count = 0;
    for (std::size_t start = 0; start < wall.size(); ++start) {
      if (piece[start] >= 0) continue;
      std::vector<std::size_t> front{start};
      piece[start] = count;
      while (!front.empty()) {
        const std::size_t at = front.back();
        front.pop_back();
        const int i = int(at % nx), j = int(at / nx);
        const auto visit = [&](int a, int b) {
          if (a < 0 || a >= nx || b < 0 || b >= ny) return;
          const std::size_t to = std::size_t(b) * nx + a;
          if (piece[to] >= 0 || wall[to] != wall[start]) return;
          piece[to] = count;
          front.push_back(to);
        };
        visit(i + 1, j), visit(i - 1, j), visit(i, j + 1), visit(i, j - 1);
      }
      ++count;
    }
    return piece;
  }
};

struct Shipped {
  std::string name;
  int nx, ny;
  double density;
};

std::ostream& operator<<(std::ostream& out, const Shipped& wood)
{
  return out << wood.name;
}

class ShippedWood : public ::testing::TestWithParam<Shipped> {
 protected:
  Parameters parameters() const
  {
    return read_parameters(wood_file(GetParam().name + ".anatomy.yaml"));
  }
  Drawing drawing() const { return draw(parameters(), parameters().seed); }
  Walls walls() const { return {drawing(), GetParam().nx, GetParam().ny}; }
};

TEST_P(ShippedWood, IsRedrawnByteForByteFromItsParameters)
{
  const std::vector<std::uint8_t> shipped = bytes_of(wood_file(GetParam().name + ".bmp"));
  EXPECT_TRUE(bmp_bytes(drawing(), parameters().picture) == shipped);
}

TEST_P(ShippedWood, HasThePaperRelativeDensityOnThePaperLattice)
{
  // The generator scales the walls until this lattice agrees; 0.003 is the rounding of the paper.
  EXPECT_NEAR(walls().density(), GetParam().density, 0.003);
}

TEST_P(ShippedWood, WallIsOnePieceThatSpansTheSampleBothWays)
{
  const Walls lattice = walls();
  const std::vector<int> piece = lattice.pieces();
  std::map<int, long> size;
  long wall = 0;
  for (std::size_t k = 0; k < piece.size(); ++k)
    if (lattice.wall[k]) ++size[piece[k]], ++wall;
  int largest = size.begin()->first;
  for (const auto& [label, count] : size)
    if (count > size[largest]) largest = label;
  EXPECT_GE(size[largest], 0.999 * wall);
  bool left = false, right = false, top = false, bottom = false;
  for (int j = 0; j < lattice.ny; ++j) {
    left = left || piece[std::size_t(j) * lattice.nx] == largest;
    right = right || piece[std::size_t(j + 1) * lattice.nx - 1] == largest;
  }
  for (int i = 0; i < lattice.nx; ++i) {
    top = top || piece[i] == largest;
    bottom = bottom || piece[std::size_t(lattice.ny - 1) * lattice.nx + i] == largest;
  }
  EXPECT_TRUE(left && right && top && bottom);
}

TEST_P(ShippedWood, LumensAreClosed)
{
  const Drawing picture = drawing();
  const Walls lattice(picture, GetParam().nx, GetParam().ny);
  const std::vector<int> piece = lattice.pieces();
  std::set<int> seen;
  int open = 0, resolved = 0;
  for (const Point& lumen : picture.lumens) {
    const auto i = std::size_t((lumen.x + 0.5) * lattice.nx / picture.width);
    const auto j = std::size_t((lumen.y + 0.5) * lattice.ny / picture.height);
    if (lattice.wall[j * lattice.nx + i]) continue;
    ++resolved;
    if (!seen.insert(piece[j * lattice.nx + i]).second) ++open;
  }
  // Walls of about two locations: one in a hundred may have a gap.
  EXPECT_GE(resolved, 0.97 * double(picture.lumens.size()));
  EXPECT_LE(open, 0.01 * resolved);
}

TEST_P(ShippedWood, AnotherSeedIsAnotherPictureOfTheSameDensity)
{
  const Drawing other = draw(parameters(), parameters().seed + 1);
  EXPECT_NE(other.gray, drawing().gray);
  EXPECT_NEAR(Walls(other, GetParam().nx, GetParam().ny).density(), GetParam().density, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Wood, ShippedWood,
                         ::testing::Values(Shipped{"loblolly", 300, 194, 0.607},
                                           Shipped{"poplar", 300, 196, 0.563},
                                           Shipped{"ponderosa", 400, 516, 0.369}),
                         [](const auto& test) { return test.param.name; });

TEST(Loblolly, EarlywoodAndLatewoodHaveThePaperDensities)
{
  const Parameters wood = read_parameters(wood_file("loblolly.anatomy.yaml"));
  const Walls lattice(draw(wood, wood.seed), 300, 194);
  EXPECT_NEAR(lattice.density(0, 0.473), 0.404, 0.01);
  EXPECT_NEAR(lattice.density(0.473, 1), 0.791, 0.01);
}

TEST(Ponderosa, ResinCanalIsTheLargestLumen)
{
  const Parameters wood = read_parameters(wood_file("ponderosa.anatomy.yaml"));
  const Walls lattice(draw(wood, wood.seed), 400, 516);
  const std::vector<int> piece = lattice.pieces();
  std::map<int, long> size;
  for (std::size_t k = 0; k < piece.size(); ++k)
    if (!lattice.wall[k]) ++size[piece[k]];
  long largest = 0;
  for (const auto& [label, count] : size) largest = std::max(largest, count);
  const ResinCanal& canal = wood.resin_canals.at(0);
  const int i = int(canal.x / wood.picture.width * 400),
            j = int(canal.y / wood.picture.height * 516);
  ASSERT_FALSE(lattice.wall[std::size_t(j) * 400 + i]);
  EXPECT_EQ(size[piece[std::size_t(j) * 400 + i]], largest);
  // Ellipse of the canal's inner diameter, as long as the stretch; waves change it by some per
  // cent.
  const double open = canal.diameter - 2 * canal.wall;
  const double ellipse = 3.14159 / 4 * open * open * wood.files.stretch;
  EXPECT_NEAR(double(largest), ellipse / (2.5 * 2.5), 0.15 * ellipse / (2.5 * 2.5));
}

TEST(Drawing, GrayLevelsOfWallAndLumenStayApart)
{
  const Parameters wood = read_parameters(wood_file("loblolly.anatomy.yaml"));
  const Drawing picture = draw(wood, wood.seed);
  long near_threshold = 0;
  for (const std::uint8_t level : picture.gray) near_threshold += level >= 140 && level < 160;
  // Only pixels on a rim lie between the levels; rims run through about a quarter of the pixels.
  EXPECT_LT(near_threshold, 0.08 * double(picture.gray.size()));
}

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
