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

#include "drawn_wood.hpp"
#include <gmock/gmock.h>

namespace {

using namespace mpm::micrograph::anatomy;
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

}  // namespace
