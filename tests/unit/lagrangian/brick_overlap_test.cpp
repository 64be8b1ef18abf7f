// The volume in which bricks lie upon each other, against boxes, counted points and differences.
#include <mpm/lagrangian/brick_overlap.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double lower, double upper)
  {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  Vec<3> vector(double most)
  {
    return Vec<3>::NullaryExpr([&] { return between(-most, most); });
  }
  /// Not turned inside out, and flattened to a tenth at most.
  Eigen::Matrix3d matrix()
  {
    for (;;) {
      const Eigen::Matrix3d found = Eigen::Matrix3d::NullaryExpr([&] { return between(-1, 1); });
      if (found.determinant() > 0.1) return found;
    }
  }
  Parallelepiped brick(double spread) { return {vector(spread), matrix()}; }

 private:
  std::mt19937 engine_;
};

Parallelepiped box(const Vec<3>& centre, const Vec<3>& size)
{
  return {centre, size.asDiagonal()};
}

double volume_of_boxes(const Parallelepiped& a, const Parallelepiped& b)
{
  double volume = 1;
  for (int d = 0; d < 3; ++d)
    volume *= std::max(
        0.0, std::min(a.centre[d] + a.edges(d, d) / 2, b.centre[d] + b.edges(d, d) / 2) -
                 std::max(a.centre[d] - a.edges(d, d) / 2, b.centre[d] - b.edges(d, d) / 2));
  return volume;
}

Parallelepiped moved(const Parallelepiped& brick, const Eigen::Matrix3d& map)
{
  return {map * brick.centre, map * brick.edges};
}

/// Boxes in skewed axes: each pair of faces is parallel.
TEST(BrickOverlap, IsThatOfBoxesInAnyAxes)
{
  Random random(1);
  int apart = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto size = [&] { return Vec<3>(random.vector(0.4).array() + 0.6); };
    const Parallelepiped a = box(random.vector(0.6), size()), b = box(random.vector(0.6), size());
    const Eigen::Matrix3d map = trial % 2 == 0 ? Eigen::Matrix3d::Identity() : random.matrix();
    const double expected = volume_of_boxes(a, b) * map.determinant();
    apart += expected == 0;
    ASSERT_NEAR(overlap_of(moved(a, map), moved(b, map)).volume, expected, 1e-11) << trial;
  }
  EXPECT_GT(apart, 100);
}

/// The middles of 60^3 parts of one brick that lie in the other as well.
TEST(BrickOverlap, IsTheShareOfPointsThatLieInBoth)
{
  constexpr int parts = 60;
  Random random(2);
  int met = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Parallelepiped a = random.brick(0.6), b = random.brick(0.6);
    const Eigen::Matrix3d into_b = b.edges.inverse();
    int within = 0;
    for (int k = 0; k < parts * parts * parts; ++k) {
      const Vec<3> index(k % parts, k / parts % parts, k / (parts * parts));
      const Vec<3> xi = ((index.array() + 0.5) / parts - 0.5).matrix();
      const Vec<3> in_b = into_b * (a.centre + a.edges * xi - b.centre);
      within += in_b.cwiseAbs().maxCoeff() < 0.5;
    }
    const double part = overlap_of(a, b).volume / a.edges.determinant();
    met += within > 0;
    // Of the parts that a face goes through as many are counted that are not as the other way.
    ASSERT_NEAR(part, double(within) / (parts * parts * parts), 2e-3) << trial;
  }
  EXPECT_GT(met, 20);
}

TEST(BrickOverlap, IsTheSameTheOtherWayRound)
{
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Parallelepiped a = random.brick(0.7), b = random.brick(0.7);
    const BrickOverlap one = overlap_of(a, b), other = overlap_of(b, a);
    ASSERT_NEAR(one.volume, other.volume, 1e-11);
    ASSERT_LT((one.a.by_edges - other.b.by_edges).norm(), 1e-10);
    ASSERT_LT((one.b.by_edges - other.a.by_edges).norm(), 1e-10);
  }
}

TEST(BrickOverlap, HasSlopesThatAreThoseOfTheVolume)
{
  constexpr double step = 1e-6;
  Random random(4);
  int met = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Parallelepiped bricks[2] = {random.brick(0.6), random.brick(0.6)};
    const BrickOverlap found = overlap_of(bricks[0], bricks[1]);
    met += found.volume > 0;
    for (int which = 0; which < 2; ++which)
      for (int k = 0; k < 12; ++k) {
        const auto& slopes = which == 0 ? found.a : found.b;
        double& value = k < 3 ? bricks[which].centre[k] : bricks[which].edges(k % 3, k / 3 - 1);
        const double slope = k < 3 ? slopes.by_centre[k] : slopes.by_edges(k % 3, k / 3 - 1);
        const double before = value;
        value = before + step;
        const double above = overlap_of(bricks[0], bricks[1]).volume;
        value = before - step;
        const double below = overlap_of(bricks[0], bricks[1]).volume;
        value = before;
        // Where a corner comes to a plane within the step slopes change.
        ASSERT_NEAR(slope, (above - below) / (2 * step), 2e-6) << trial << " " << k;
      }
  }
  EXPECT_GT(met, 120);
}

TEST(BrickOverlap, PushesNeitherTheTwoTogetherNorTurnsThem)
{
  Random random(5);
  for (int trial = 0; trial < 500; ++trial) {
    const Parallelepiped a = random.brick(0.6), b = random.brick(0.6);
    const BrickOverlap found = overlap_of(a, b);
    Vec<3> turn = Vec<3>::Zero();
    for (const auto& [brick, slopes] : {std::pair(a, found.a), std::pair(b, found.b)}) {
      turn += brick.centre.cross(slopes.by_centre);
      for (int k = 0; k < 3; ++k)
        turn += Vec<3>(brick.edges.col(k)).cross(Vec<3>(slopes.by_edges.col(k)));
    }
    ASSERT_LT((found.a.by_centre + found.b.by_centre).norm(), 1e-11);
    ASSERT_LT(turn.norm(), 1e-11);
  }
}

/// Faces in one plane, but for rounding: on the same side of it they count once, on different sides
/// there is no volume; shared corners and edges are no trouble.
TEST(BrickOverlap, CountsFlushFacesOnce)
{
  Random random(6);
  const Vec<3> size(1, 0.8, 1.2);
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec<3> shift =
        Vec<3>::NullaryExpr([&] { return 0.5 * std::round(random.between(-2.4, 2.4)); });
    const Vec<3> place = random.vector(50);
    const Eigen::Matrix3d map = trial % 2 == 0 ? Eigen::Matrix3d::Identity() : random.matrix();
    Parallelepiped a = moved(box(place, size), map),
                   b = moved(box(place + size.cwiseProduct(shift), size), map);
    const double noise = trial % 3 == 0 ? 0 : std::pow(10, -10 - random.between(0, 6));
    b.edges += noise * Eigen::Matrix3d::NullaryExpr([&] { return random.between(-1, 1); });
    const double expected =
        (1 - shift.array().abs()).max(0).prod() * size.prod() * map.determinant();
    const BrickOverlap found = overlap_of(a, b);
    ASSERT_NEAR(found.volume, expected, 1e-10) << trial << " " << shift.transpose();
    ASSERT_LT((found.a.by_centre + found.b.by_centre).norm(), 1e-11) << trial;
  }
}

TEST(BrickOverlap, IsNothingWhereABrickIsTurnedInsideOut)
{
  Parallelepiped a = box(Vec<3>::Zero(), Vec<3>::Ones()), b = a;
  b.edges.col(0) *= -1;
  EXPECT_EQ(overlap_of(a, b).volume, 0);
  b.edges.col(0) *= 0;
  EXPECT_EQ(overlap_of(a, b).volume, 0);
}

}  // namespace
}  // namespace mpm
