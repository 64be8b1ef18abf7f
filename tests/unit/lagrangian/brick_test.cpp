// Bricks of one point: stretch and modes, forces that are the gradient of an energy, plates and
// beams that are bent and twisted, elastic and beyond yield.
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic_solid.hpp>
#include <mpm/materials/laws.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "led_brick.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<3> size(0.3, 0.2, 0.25);
const IsotropicConstants elastic{10.0, 0.3};

LedBrick soft_brick()
{
  return {make_hencky_solid(elastic, 1000, {}), 1000, size};
}

BrickPlaces at_rest()
{
  BrickPlaces places;
  for (int c = 0; c < 8; ++c)
    for (int d = 0; d < 3; ++d) places(d, c) = ((c >> d & 1) - 0.5) * size[d];
  return places;
}

/// The products Y Z, Z X, X Y and X Y Z at a corner.
Eigen::Vector4d modes_at(int corner)
{
  const Vec<3> at = at_rest().col(corner);
  return {at[1] * at[2], at[2] * at[0], at[0] * at[1], at.prod()};
}

TEST(Brick, IsStretchedAndBentAsItsCornersSay)
{
  Eigen::Matrix3d f;
  f << 1.2, 0.3, -0.2, -0.1, 0.8, 0.15, 0.05, -0.25, 1.1;
  Eigen::Matrix<double, 3, 4> b;
  b << 0.4, -0.7, 0.2, 1.5, 0.3, 0.6, -0.5, -2.0, -0.8, 0.1, 0.9, 0.7;
  CellCorners<3> corners;
  for (int c = 0; c < 8; ++c) {
    const Vec<3> place = f * (at_rest().col(c) + b * modes_at(c));
    for (int d = 0; d < 3; ++d) corners.along[d][c] = place[d];
  }
  const CellFrame<3> frame(size);
  const CellDeformation<3> found(corners, frame);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(found.f[k][0], f(k % 3, k / 3), 1e-14);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(found.bending[k][0], b(k % 3, k / 3), 1e-12);
  EXPECT_LE(found.narrowest_corner(frame)[0], narrowest_share(corners, frame)[0]);
}

/// Also where stretches coincide.
TEST(Brick, KnowsItsLeastStretch)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> logarithm(std::log(0.05), std::log(3.0));
  for (int trial = 0; trial < 300; ++trial) {
    Vec<3> stretch(logarithm(random), logarithm(random), logarithm(random));
    if (trial % 3 == 0) stretch[1] = stretch[0];
    if (trial % 9 == 0) stretch[2] = stretch[0];
    stretch = stretch.array().exp();
    const Eigen::Matrix3d turn = Eigen::Quaterniond::UnitRandom().toRotationMatrix(),
                          f = turn * stretch.asDiagonal() *
                              Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    CellCorners<3> corners;
    for (int c = 0; c < 8; ++c) {
      const Vec<3> place = f * at_rest().col(c);
      for (int d = 0; d < 3; ++d) corners.along[d][c] = place[d];
    }
    const CellDeformation<3> now(corners, CellFrame<3>(size));
    const double least = std::sqrt(least_stretch_squared(now)[0]) / stretch.minCoeff();
    ASSERT_NEAR(least, 1, 1e-11) << stretch.transpose();
  }
}

/// Of all lengths, and far enough that corners are held open.
TEST(Brick, HasForcesThatAreTheGradientOfItsEnergy)
{
  std::mt19937 random(5);
  int held = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double reach = trial < 30 ? 0.04 : 0.085;
    std::uniform_real_distribution<double> around(-reach, reach);
    BrickPlaces places = at_rest();
    for (double& value : places.reshaped()) value += around(random);
    LedBrick brick = soft_brick();
    if (!brick.lead_to(places)) continue;
    const BrickPlaces force = brick.force();
    CellCorners<3> corners;
    for (int c = 0; c < 8; ++c)
      for (int d = 0; d < 3; ++d) corners.along[d][c] = places(d, c);
    held += narrowest_share(corners, CellFrame<3>(size))[0] < least_corner;
    constexpr double step = 1e-6;
    for (int i = 0; i < 24; ++i) {
      const auto energy_at = [&](double value) {
        BrickPlaces moved = places;
        moved(i % 3, i / 3) = value;
        brick.lead_to(moved);
        return brick.stored();
      };
      const double at = places(i % 3, i / 3);
      const double slope = (energy_at(at + step) - energy_at(at - step)) / (2 * step);
      ASSERT_NEAR(force(i % 3, i / 3), -slope, 1e-6 * (1 + std::abs(slope)))
          << "trial " << trial << ", " << i;
      brick.lead_to(places);
    }
    ASSERT_LT(force.rowwise().sum().norm(), 1e-12 * (1 + force.norm()));
    Vec<3> turn = Vec<3>::Zero();
    for (int c = 0; c < 8; ++c) turn += Vec<3>(places.col(c)).cross(Vec<3>(force.col(c)));
    ASSERT_LT(turn.norm(), 1e-12 * (1 + force.norm()));
  }
  EXPECT_GT(held, 3);
}

TEST(Brick, IsNeitherStretchedNorBentByATurn)
{
  for (const double angle : {0.3, 1.9, 3.0}) {
    LedBrick brick = soft_brick();
    const Eigen::AngleAxisd turn(angle, Vec<3>(1, -2, 0.5).normalized());
    ASSERT_TRUE(brick.lead_to(turn.toRotationMatrix() * at_rest()));
    EXPECT_LT(brick.force().norm(), 1e-13);
    EXPECT_NEAR(brick.stored(), 0, 1e-26);
  }
}

/// Curvatures (1/m) of a plate across axis j: of its fibres along the next axis and the one after
/// that, and half of the twist, as w = first x^2 / 2 + second y^2 / 2 + twist x y makes them.
struct Curved {
  int across;
  double first, second, twist;

  BrickPlaces places() const
  {
    const int j = across, i = (j + 1) % 3, k = (j + 2) % 3;
    BrickPlaces places = at_rest();
    for (int c = 0; c < 8; ++c) {
      const Vec<3> at = at_rest().col(c);
      places(i, c) -= at[j] * (first * at[i] + twist * at[k]);
      places(k, c) -= at[j] * (second * at[k] + twist * at[i]);
      places(j, c) += twist * at[i] * at[k];
    }
    return places;
  }
  double area() const { return size.prod() / size[across]; }
  /// Of a thin plate, J (Timoshenko & Woinowsky-Krieger 1959, ch. 2).
  double energy() const
  {
    const double nu = elastic.poisson_ratio;
    const double plate =
        elastic.youngs_modulus * std::pow(size[across], 3) / (12 * (1 - nu * nu)) * area();
    return 0.5 * plate *
           (first * first + second * second + 2 * nu * first * second +
            2 * (1 - nu) * twist * twist);
  }
};

TEST(Brick, BendsAndTwistsWithTheStiffnessOfAPlate)
{
  constexpr double c = 1e-3;
  for (int across = 0; across < 3; ++across)
    for (const Curved& curved : {Curved{across, c, 0, 0}, Curved{across, 0, c, 0},
                                 Curved{across, c, c, 0}, Curved{across, c, -c, 0},
                                 Curved{across, 0, 0, c}, Curved{across, c, -0.3 * c, 0.4 * c}}) {
      LedBrick brick = soft_brick();
      brick.lead_to(curved.places());
      EXPECT_NEAR(brick.stored() / curved.energy(), 1, 1e-6) << across;
      LedBrick rubber(make_law<3>(*OneOf<LawRow>("neo_hookean"),
                                  {{"density", 1000.0},
                                   {"youngs_modulus", elastic.youngs_modulus},
                                   {"poisson_ratio", elastic.poisson_ratio}},
                                  {}),
                      1000, size);
      rubber.lead_to(curved.places());
      EXPECT_NEAR(rubber.stored() / curved.energy(), 1, 1e-6) << across;
    }
}

// Beyond yield.

constexpr double density = 1500;
const IsotropicConstants wall{10e9, 0.3};
const YieldConstants yield{100e6, 0};

using MakeLaw = std::unique_ptr<Law<3>> (*)();
std::unique_ptr<Law<3>> hencky()
{
  return make_hencky_solid(wall, density, yield);
}
std::unique_ptr<Law<3>> hypoelastic()
{
  return make_hypoelastic_solid(wall, density, yield);
}

class PlasticBrick : public ::testing::TestWithParam<MakeLaw> {
 protected:
  /// N m, on the end of fibres along the axis after `across`; and on that of those along the last.
  static Eigen::Vector2d moments(LedBrick& brick, int across)
  {
    const BrickPlaces force = brick.force();
    Eigen::Vector2d moments = Eigen::Vector2d::Zero();
    for (int c = 0; c < 8; ++c)
      for (int n = 0; n < 2; ++n) {
        const int fibre = (across + 1 + n) % 3;
        if (c >> fibre & 1) moments[n] += force(fibre, c) * at_rest()(across, c);
      }
    return moments;
  }
  /// N m, of a section that yields all through in uniaxial stress, across the fibres.
  static double plastic_moment(int across)
  {
    return yield.yield_stress * size[across] * size[across] / 4 * size[(across + 2) % 3];
  }
  static double first_curvature(int across)
  {
    return 3 * yield.yield_stress / (wall.youngs_modulus * size[across]);
  }
  static constexpr int steps = 2000;
};

TEST_P(PlasticBrick, BentAsAPlateStopsAtThePlasticMomentInPlaneStrain)
{
  for (int across = 0; across < 3; ++across) {
    LedBrick brick(GetParam()(), density, size);
    const double last = 8 * first_curvature(across);
    for (int k = 1; k <= steps; ++k)
      ASSERT_TRUE(brick.lead_to(Curved{across, last * k / steps, 0, 0}.places()));
    EXPECT_NEAR(moments(brick, across)[0] / plastic_moment(across), 2 / std::sqrt(3.0), 0.01);
    EXPECT_NEAR((brick.stored() + brick.dissipated()) / brick.work(), 1, 1e-5);
  }
}

/// The other curvature is led so that the sides stay free.
TEST_P(PlasticBrick, BentAsABeamStopsAtThePlasticMoment)
{
  for (int across = 0; across < 3; ++across) {
    LedBrick brick(GetParam()(), density, size);
    const double step = 6 * first_curvature(across) / steps;
    const int last = (across + 2) % 3;
    const double stiffness = wall.youngs_modulus * std::pow(size[across], 3) / 12 * size.prod() /
                             size[across] / size[last];
    Curved curved{across, 0, 0, 0};
    for (int k = 0; k < steps; ++k) {
      curved.first += step;
      curved.second -= 0.5 * moments(brick, across)[1] / stiffness;
      ASSERT_TRUE(brick.lead_to(curved.places()));
    }
    EXPECT_NEAR(moments(brick, across)[0] / plastic_moment(across), 1, 5e-3);
    EXPECT_NEAR(moments(brick, across)[1] / plastic_moment(across), 0, 5e-3);
    EXPECT_NEAR((brick.stored() + brick.dissipated()) / brick.work(), 1, 1e-5);
  }
}

TEST_P(PlasticBrick, TwistedAsAPlateStopsAtThePlasticMoment)
{
  LedBrick brick(GetParam()(), density, size);
  const int across = 2;
  const double last = 6 * first_curvature(across);
  for (int k = 1; k <= steps; ++k)
    ASSERT_TRUE(brick.lead_to(Curved{across, 0, 0, last * k / steps}.places()));
  // Work of twice the twist against the moment per length.
  const double before = brick.work();
  brick.lead_to(Curved{across, 0, 0, last * (steps + 1) / steps}.places());
  const double moment = (brick.work() - before) / (2 * last / steps * size[0] * size[1]);
  EXPECT_NEAR(moment / (yield.yield_stress / std::sqrt(3.0) * size[2] * size[2] / 4), 1, 5e-3);
}

/// Bricks of a wall that is bent around a line away from its middle, each drawn by as much as it is
/// away from there, and led so that they are free to get thinner.
TEST_P(PlasticBrick, WallsOfSeveralBricksBearWhatASectionDoesThatYieldsAllThrough)
{
  constexpr YieldConstants soft{1e6, 0};
  const double held = 2 / std::sqrt(3.0) * soft.yield_stress;
  for (int across = 0; across < 3; ++across)
    for (const int bricks : {1, 2, 4})
      for (const double shift : {0.0, 0.6}) {
        const int fibre = (across + 1) % 3;
        const double thickness = bricks * size[across], width = size[(across + 2) % 3];
        const double curvature = 40 * held / wall.youngs_modulus / thickness;
        double moment = 0, force = 0;
        for (int k = 0; k < bricks; ++k) {
          LedBrick brick(GetParam() == hencky ? make_hencky_solid(wall, density, soft)
                                              : make_hypoelastic_solid(wall, density, soft),
                         density, size);
          const double from_middle = (k + 0.5) * size[across] - 0.5 * thickness;
          const double last = curvature * (from_middle + 0.5 * shift * thickness);
          double thinner = 0;
          const auto end = [&](int axis) {  // N, on the upper end
            double sum = 0;
            for (int c = 0; c < 8; ++c)
              if (c >> axis & 1) sum -= brick.force()(axis, c);
            return sum;
          };
          for (int step = 1; step <= 2 * steps; ++step) {
            const double so_far = double(step) / (2 * steps);
            thinner -= 0.5 * end(across) * size[across] / size.prod() / wall.wave_modulus();
            BrickPlaces places = Curved{across, curvature * so_far, 0, 0}.places();
            places.row(fibre) += last * so_far * at_rest().row(fibre);
            places.row(across) += thinner * at_rest().row(across);
            ASSERT_TRUE(brick.lead_to(places));
          }
          const double drawn = end(fibre);
          moment += std::abs(moments(brick, across)[0]) + from_middle * drawn;
          force += drawn;
        }
        EXPECT_NEAR(moment / (held * thickness * thickness / 4 * width), 1 - shift * shift, 0.02)
            << bricks << " bricks across axis " << across;
        EXPECT_NEAR(force / (held * thickness * width), shift, 0.02)
            << bricks << " bricks across axis " << across;
      }
}

INSTANTIATE_TEST_SUITE_P(Laws, PlasticBrick, ::testing::Values(hencky, hypoelastic),
                         [](const auto& info) {
                           return std::string(info.param == hencky ? "Hencky" : "Hypoelastic");
                         });

}  // namespace
}  // namespace mpm
