// The area on which cells lie upon each other, against polygons clipped one side after the other.
#include <mpm/lagrangian/overlap.hpp>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace mpm {
namespace {

struct Point {
  double x, y;
};
using Cell = std::array<Point, 4>;

double cross(const Point& a, const Point& b, const Point& c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area_of(const std::vector<Point>& polygon)
{
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

/// Sutherland & Hodgman 1974.
double clipped_area(const Cell& a, const Cell& b)
{
  std::vector<Point> polygon(a.begin(), a.end());
  for (int j = 0; j < 4; ++j) {
    std::vector<Point> kept;
    const Point &from = b[j], &to = b[(j + 1) % 4];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const double at_p = cross(from, to, p), at_q = cross(from, to, q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
        const double t = at_p / (at_p - at_q);
        kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      }
    }
    polygon = kept;
  }
  return polygon.empty() ? 0 : area_of(polygon);
}

Quads in_all_lanes(const Cell& cell)
{
  Quads quads;
  for (int k = 0; k < 4; ++k) {
    quads.x[k] = cell[k].x;
    quads.y[k] = cell[k].y;
  }
  return quads;
}

bool is_convex(const Cell& cell)
{
  for (int k = 0; k < 4; ++k)
    if (cross(cell[k], cell[(k + 1) % 4], cell[(k + 2) % 4]) < 0.05) return false;
  return true;
}

Cell random_cell(std::mt19937& random, double spread)
{
  std::uniform_real_distribution<double> around(-0.4, 0.4), place(-spread, spread);
  std::uniform_real_distribution<double> angle(0, 2 * M_PI);
  for (;;) {
    const double c = std::cos(angle(random)), s = std::sqrt(1 - c * c);
    const Point at{place(random), place(random)};
    Cell cell{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
    for (Point& p : cell) {
      const Point q{p.x + around(random), p.y + around(random)};
      p = {at.x + c * q.x - s * q.y, at.y + s * q.x + c * q.y};
    }
    if (is_convex(cell)) return cell;
  }
}

double overlap(const Cell& a, const Cell& b)
{
  return overlap_of(in_all_lanes(a), in_all_lanes(b)).area[lane_count - 1];
}

constexpr double rounding = 1e-13;

TEST(Overlap, IsTheAreaOfTheClippedPolygon)
{
  std::mt19937 random(7);
  int meet = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Cell a = random_cell(random, 0.8), b = random_cell(random, 0.8);
    const double area = clipped_area(a, b);
    meet += area > 0;
    ASSERT_NEAR(overlap(a, b), area, rounding) << "trial " << trial;
    ASSERT_NEAR(overlap(b, a), area, rounding) << "trial " << trial;
  }
  EXPECT_GT(meet, 10000);
}

TEST(Overlap, HasTheDerivativesOfItsArea)
{
  std::mt19937 random(11);
  constexpr double step = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    std::array<Cell, 2> cells{random_cell(random, 0.5), random_cell(random, 0.5)};
    const Overlap found = overlap_of(in_all_lanes(cells[0]), in_all_lanes(cells[1]));
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d) {
          double& value = d == 0 ? cells[c][k].x : cells[c][k].y;
          const double kept = value;
          value = kept + step;
          const double above = clipped_area(cells[0], cells[1]);
          value = kept - step;
          const double below = clipped_area(cells[0], cells[1]);
          value = kept;
          const Lanes* by =
              c == 0 ? (d == 0 ? found.a_x : found.a_y) : (d == 0 ? found.b_x : found.b_y);
          ASSERT_NEAR(by[k][0], (above - below) / (2 * step), 2e-6)
              << "trial " << trial << ", cell " << c << ", corner " << k << ", axis " << d;
        }
  }
}

TEST(Overlap, PushesAsMuchAsItIsPushedAndTurnsNothing)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const Cell a = random_cell(random, 0.6), b = random_cell(random, 0.6);
    const Overlap found = overlap_of(in_all_lanes(a), in_all_lanes(b));
    double x = 0, y = 0, turn = 0;
    for (int k = 0; k < 4; ++k) {
      x += found.a_x[k][0] + found.b_x[k][0];
      y += found.a_y[k][0] + found.b_y[k][0];
      turn += a[k].x * found.a_y[k][0] - a[k].y * found.a_x[k][0] + b[k].x * found.b_y[k][0] -
              b[k].y * found.b_x[k][0];
    }
    ASSERT_NEAR(x, 0, rounding);
    ASSERT_NEAR(y, 0, rounding);
    ASSERT_NEAR(turn, 0, rounding);
  }
}

TEST(Overlap, CountsASideThatBothShareOnce)
{
  const Cell a{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  EXPECT_DOUBLE_EQ(overlap(a, a), 1);
  const Cell half{{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}}};
  EXPECT_DOUBLE_EQ(overlap(a, half), 0.5);
  const Cell beside{{{1, 0}, {2, 0}, {2, 1}, {1, 1}}};
  EXPECT_DOUBLE_EQ(overlap(a, beside), 0);
  const Overlap side = overlap_of(in_all_lanes(a), in_all_lanes(half));
  double push = 0;
  for (int k = 0; k < 4; ++k) push += side.a_y[k][0] + side.b_y[k][0];
  EXPECT_NEAR(push, 0, rounding);
}

TEST(Overlap, TakesATriangleThatNamesACornerTwice)
{
  const Cell square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (const Cell& triangle :
       {Cell{{{0, 0}, {1, 0}, {0, 1}, {0, 1}}}, Cell{{{0, 0}, {0, 0}, {1, 0}, {0, 1}}}}) {
    EXPECT_DOUBLE_EQ(overlap(square, triangle), 0.5);
    EXPECT_DOUBLE_EQ(overlap(triangle, square), 0.5);
    const Cell away{{{0.25, 0.25}, {2, 0.25}, {2, 2}, {0.25, 2}}};
    EXPECT_NEAR(overlap(triangle, away), 0.125, rounding);
    EXPECT_NEAR(overlap(away, triangle), 0.125, rounding);
  }
}

/// Ends that rounding puts to either side of the other's line decide nothing: the boundary stays
/// closed, and the derivatives sum to zero.
TEST(Overlap, HasAClosedBoundaryWhereSidesLieOnOneLine)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1e-16, 1e-16), shift(0.1, 0.9);
  for (int trial = 0; trial < 2000; ++trial) {
    const double s = shift(random);
    // The upper side of the first is on the line of the second's upper or lower one.
    const double lower = trial % 2 == 0 ? 0.0 : 1.0;
    Cell a{{{0, 0}, {1, 0}, {1.1, 1}, {0.1, 1}}};
    Cell b{{{s, lower}, {s + 1, lower}, {s + 1, lower + 1}, {s, lower + 1}}};
    for (Cell* cell : {&a, &b})
      for (Point& corner : *cell) corner.y += noise(random);
    const Overlap found = overlap_of(in_all_lanes(a), in_all_lanes(b));
    double x = 0, y = 0;
    for (int k = 0; k < 4; ++k) {
      x += found.a_x[k][0] + found.b_x[k][0];
      y += found.a_y[k][0] + found.b_y[k][0];
    }
    ASSERT_NEAR(x, 0, 1e-13) << "trial " << trial;
    ASSERT_NEAR(y, 0, 1e-13) << "trial " << trial;
    ASSERT_NEAR(found.area[0], clipped_area(a, b), 1e-12) << "trial " << trial;
  }
}

}  // namespace
}  // namespace mpm
