// Corners of locations on the surface of a wall.
#include <mpm/micrograph/fitted_corners.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace mpm::micrograph {
namespace {

/// A wall between two parallel lines.
struct Inclined final : WallPlaces<2> {
  double slope, lower, upper;
  Inclined(double slope_, double lower_, double upper_)
      : slope(slope_), lower(lower_), upper(upper_)
  {
  }
  bool contains(const Vec<2>& at) const override
  {
    const double y = at[1] - slope * at[0];
    return y >= lower && y < upper;
  }
};

FittedLattice lattice_of(const WallPlaces<2>& wall, const IndexVec<2>& count, bool periodic = false)
{
  return {count,
          Vec<2>(1, 1),
          {periodic, false},
          [&wall](const IndexVec<2>& at) {
            const Vec<2> centre = at.cast<double>() + Vec<2>::Constant(0.5);
            return wall.contains(centre) ? 0 : -1;
          },
          [](const IndexVec<2>&) { return false; }};
}

IndexBox<2> whole(const IndexVec<2>& count)
{
  return {IndexVec<2>::Zero(), count};
}

IndexBox<2> corners_of(const IndexBox<2>& locations)
{
  return {locations.lower, locations.upper + IndexVec<2>::Constant(1)};
}

/// Of the wall's cells.
double area(const CornerOffsets<2>& offsets, const FittedLattice& lattice)
{
  double sum = 0;
  for_each_index(whole(lattice.count), [&](const IndexVec<2>& at) {
    if (lattice.body(at) < 0) return;
    const auto x = [&](int i, int j) -> Vec<2> {
      const IndexVec<2> corner = at + IndexVec<2>(i, j);
      return corner.cast<double>() + offsets(corner);
    };
    const Vec<2> u = x(1, 1) - x(0, 0), w = x(0, 1) - x(1, 0);
    const double cell = 0.5 * (u[0] * w[1] - u[1] * w[0]);
    EXPECT_GT(cell, 0.3);
    sum += cell;
  });
  return sum;
}

TEST(FittedCorners, ThatStayDoSoAtBothEndsOfAPeriod)
{
  const IndexVec<2> count(20, 12);
  const Inclined wall(0, 4.3, 6.8);
  FittedLattice lattice = lattice_of(wall, count, true);
  lattice.stays = [](const IndexVec<2>& at) { return at[0] == 0 && at[1] == 4; };
  const CornerOffsets<2> fitted = fitted_corners(whole(count), lattice, wall);
  EXPECT_EQ(fitted({0, 4}), (Vec<2>::Zero()));
  EXPECT_NE(fitted({3, 4}), (Vec<2>::Zero()));
  for (int j = 0; j <= count[1]; ++j) {
    EXPECT_EQ(fitted({0, j}), fitted({count[0], j})) << j;
    EXPECT_EQ(fitted.way({0, j}), fitted.way({count[0], j})) << j;
  }
}

TEST(FittedCorners, StayWhereFacesLieOnTheLattice)
{
  const IndexVec<2> count(20, 12);
  const Inclined wall(0, 4, 7);
  const FittedLattice lattice = lattice_of(wall, count);
  const CornerOffsets<2> fitted = fitted_corners(whole(count), lattice, wall);
  for_each_index(corners_of(whole(count)), [&](const IndexVec<2>& at) {
    EXPECT_LT(fitted(at).norm(), 1e-8);  // the place at which a face is found is halved so far
    EXPECT_EQ(fitted.way(at), (Vec<2>::Zero()));
  });
}

TEST(FittedCorners, StandOnFacesAlongTheLattice)
{
  const IndexVec<2> count(20, 12);
  const Inclined wall(0, 4.3, 6.8);
  const FittedLattice lattice = lattice_of(wall, count);
  const CornerOffsets<2> offsets = fitted_corners(whole(count), lattice, wall);
  EXPECT_NEAR(area(offsets, lattice), 20 * 2.5, 1e-6);
  EXPECT_NEAR(offsets({7, 4})[1], 0.3, 1e-8);
  EXPECT_NEAR(offsets({7, 7})[1], -0.2, 1e-8);
  EXPECT_GT(offsets({7, 5})[1], 0.01);  // within the wall they follow a little
}

TEST(FittedCorners, GiveInclinedWallsTheirArea)
{
  const IndexVec<2> count(60, 66);
  for (const double slope : {0.2, 0.5, 0.577, 0.9}) {
    const double lower = 2.37, upper = lower + 2.1 * std::sqrt(1 + slope * slope);
    const Inclined wall(slope, lower, upper);
    const FittedLattice lattice = lattice_of(wall, count);
    const double stairs = area({}, lattice),
                 fitted = area(fitted_corners(whole(count), lattice, wall), lattice);
    const double exact = 60 * (upper - lower);
    EXPECT_NEAR(fitted / exact, 1, 0.01) << slope << ", stairs " << stairs / exact;
  }
}

TEST(FittedCorners, AreSeenNearerToTheFacesThatTheyStandBeyond)
{
  const IndexVec<2> count(60, 66);
  for (const double slope : {0.2, 0.5, 0.577, 0.9}) {
    const double length = std::sqrt(1 + slope * slope), lower = 2.37, upper = lower + 2.1 * length;
    const Inclined wall(slope, lower, upper);
    const FittedLattice lattice = lattice_of(wall, count);
    const CornerOffsets<2> offsets = fitted_corners(whole(count), lattice, wall);
    double most = 0;
    for_each_index(whole(count), [&](const IndexVec<2>& at) {
      if (at[0] < 3 || at[0] > 57) return;
      int cells = 0;
      for (int c = 0; c < 4; ++c) cells += lattice.body(at - IndexVec<2>(c & 1, c >> 1)) >= 0;
      if (cells % 4 == 0) return;
      const auto beyond = [&](const Vec<2>& place) {
        const double y = place[1] - slope * place[0];
        return std::max(lower - y, y - upper) / length;
      };
      const Vec<2> stands = at.cast<double>() + offsets(at), way = offsets.way(at);
      const double off = beyond(stands);
      if (off < -0.01) {
        EXPECT_TRUE(way.isZero(0)) << at.transpose();
      } else if (off > 0.01) {
        EXPECT_NEAR(beyond(stands + way) / off, 0.4, 0.1) << at.transpose();
      }
      most = std::max(most, off);
    });
    EXPECT_GT(most, 0.15) << slope;
  }
}

TEST(FittedCorners, MoveAlongTheBorderOnly)
{
  const IndexVec<2> count(30, 40);
  const Inclined wall(0.6, 5.2, 9.1);
  const CornerOffsets<2> offsets = fitted_corners(whole(count), lattice_of(wall, count), wall);
  double along = 0;
  for (int j = 0; j <= 40; ++j)
    for (const int i : {0, 30}) {
      EXPECT_EQ(offsets({i, j})[0], 0);
      EXPECT_EQ(offsets.way({i, j})[0], 0);
      along += std::abs(offsets({i, j})[1]);
    }
  EXPECT_GT(along, 0.1);
}

TEST(FittedCorners, AreTheSameInEveryPart)
{
  const IndexVec<2> count(90, 90);
  const Inclined wall(0.7, 8.15, 11.4);
  const FittedLattice lattice = lattice_of(wall, count);
  const CornerOffsets<2> all = fitted_corners(whole(count), lattice, wall);
  for (const IndexBox<2>& part : {IndexBox<2>{{0, 0}, {40, 90}}, IndexBox<2>{{40, 30}, {70, 61}}}) {
    const CornerOffsets<2> some = fitted_corners(part, lattice, wall);
    for_each_index(corners_of(part), [&](const IndexVec<2>& at) {
      EXPECT_EQ(some(at), all(at));
      EXPECT_EQ(some.way(at), all.way(at));
    });
  }
}

TEST(FittedCorners, AreTheSameAtBothEndsOfAPeriod)
{
  /// Waves that begin again after the period.
  struct Waves final : WallPlaces<2> {
    bool contains(const Vec<2>& at) const override
    {
      return std::abs(at[1] - 10 - 3 * std::sin(at[0] * (2 * 3.14159265358979 / 40))) < 1.6;
    }
  };
  const IndexVec<2> count(40, 20);
  const Waves wall;
  const CornerOffsets<2> offsets =
      fitted_corners(whole(count), lattice_of(wall, count, true), wall);
  double moved = 0;
  for (int j = 0; j <= 20; ++j) {
    EXPECT_EQ(offsets({0, j}), offsets({40, j}));
    EXPECT_EQ(offsets.way({0, j}), offsets.way({40, j}));
    moved += offsets({0, j}).norm();
  }
  EXPECT_GT(moved, 0.1);
}

TEST(FittedCorners, StayAtHingesAndBetweenBodies)
{
  const IndexVec<2> count(6, 6);
  const Inclined wall(0.3, 1.2, 4.4);
  FittedLattice lattice = lattice_of(wall, count);
  lattice.body = [](const IndexVec<2>& at) {
    if (at == IndexVec<2>(1, 1) || at == IndexVec<2>(2, 2)) return 0;  // meet in a corner
    return at == IndexVec<2>(3, 2) ? 1 : -1;                           // a body beside one of them
  };
  const CornerOffsets<2> offsets = fitted_corners(whole(count), lattice, wall);
  EXPECT_EQ(offsets({2, 2}), (Vec<2>::Zero()));
  EXPECT_EQ(offsets({3, 2}), (Vec<2>::Zero()));
  EXPECT_EQ(offsets({3, 3}), (Vec<2>::Zero()));
}

}  // namespace
}  // namespace mpm::micrograph
