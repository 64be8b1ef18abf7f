// Cells of one point: patch test, exact bending, and forces that are the gradient of an energy.
#include <mpm/lagrangian/plane_cell.hpp>
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/hencky.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<2> size(0.3, 0.2);
constexpr double volume = 0.06;
const IsotropicConstants elastic{10.0, 0.3};

using Places = Eigen::Matrix<double, 2, 4>;

Places at_rest()
{
  Places places;
  for (int k = 0; k < 4; ++k)
    places.col(k) << ((k & 1) - 0.5) * size[0], ((k >> 1) - 0.5) * size[1];
  return places;
}

CellCorners<2> in_all_lanes(const Places& places)
{
  CellCorners<2> corners;
  for (int k = 0; k < 4; ++k) {
    corners.along[0][k] = places(0, k);
    corners.along[1][k] = places(1, k);
  }
  return corners;
}

double stiffness(int axis)
{
  const double across = size[1 - axis];
  return elastic.in_plane_modulus(PlaneAssumption::stress) * volume * across * across / 12;
}

/// A cell from rest to these places in one step: its forces, and its energy.
struct Bent {
  Places force;
  double energy;
};
Bent bend_to(const Places& places)
{
  const auto law = make_hencky(PlaneAssumption::strain, elastic, 1000, {});
  ColumnGroup state(law->state_columns());
  state.resize(lane_count);
  for (int lane = 0; lane < lane_count; ++lane) {
    state(0, lane) = volume;
    law->initialise(state, lane);
  }
  const CellFrame<2> frame(size);
  const CellDeformation<2> deformation(in_all_lanes(places), frame);
  alignas(lane_alignment) double gradient[4 * lane_count], stress[3 * lane_count];
  for (int k = 0; k < 4; ++k)
    store(deformation.f[k] - (k % 3 == 0 ? 1.0 : 0.0), gradient + k * lane_count);
  law->update(state.block(0), 1, gradient, 1, stress);
  const Lanes tau[3] = {load(stress), load(stress + lane_count), load(stress + 2 * lane_count)};
  Bent bent;
  bent.energy = law->elastic_energy(state.block(0))[0];
  Lanes moment[2];
  for (int j = 0; j < 2; ++j) {
    moment[j] = stiffness(j) * deformation.bending[j];
    bent.energy += 0.5 * stiffness(j) * deformation.bending[j][0] * deformation.bending[j][0];
  }
  const CellCorners<2> force = corner_forces(deformation, tau, moment, frame);
  for (int k = 0; k < 4; ++k) bent.force.col(k) << force.along[0][k][0], force.along[1][k][0];
  return bent;
}

TEST(LocationCell, IsStretchedAndBentAsItsCornersSay)
{
  Eigen::Matrix2d f;
  f << 1.2, 0.3, -0.1, 0.8;
  const Eigen::Vector2d b(0.4, -0.7);
  Places places = f * at_rest();
  for (int k = 0; k < 4; ++k) places.col(k) += f * b * at_rest()(0, k) * at_rest()(1, k);
  const CellDeformation<2> found(in_all_lanes(places), CellFrame<2>(size));
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(found.f[k][0], f(k % 2, k / 2), 1e-14);
  for (int j = 0; j < 2; ++j) EXPECT_NEAR(found.bending[j][0], b[j], 1e-13);
}

TEST(LocationCell, HasForcesThatAreTheGradientOfItsEnergy)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> around(-0.06, 0.06);
  for (int trial = 0; trial < 100; ++trial) {
    Places places = at_rest();
    for (double& value : places.reshaped()) value += around(random);
    const Bent bent = bend_to(places);
    constexpr double step = 1e-6;
    for (int i = 0; i < 8; ++i) {
      Places above = places, below = places;
      above(i % 2, i / 2) += step;
      below(i % 2, i / 2) -= step;
      const double slope = (bend_to(above).energy - bend_to(below).energy) / (2 * step);
      ASSERT_NEAR(bent.force(i % 2, i / 2), -slope, 1e-7) << "trial " << trial << ", " << i;
    }
    ASSERT_LT(bent.force.rowwise().sum().norm(), 1e-14);
    double turn = 0;
    for (int k = 0; k < 4; ++k)
      turn += places(0, k) * bent.force(1, k) - places(1, k) * bent.force(0, k);
    ASSERT_NEAR(turn, 0, 1e-14);
  }
}

TEST(LocationCell, IsNeitherStretchedNorBentByATurn)
{
  for (const double angle : {0.3, 1.9, 3.0}) {
    const Bent bent = bend_to(Eigen::Rotation2Dd(angle).toRotationMatrix() * at_rest());
    EXPECT_LT(bent.force.norm(), 1e-13);
    EXPECT_NEAR(bent.energy, 0, 1e-26);
  }
}

TEST(LocationCell, IsHeldOpenByForcesThatAreTheGradientOfAnEnergy)
{
  const CellFrame<2> frame(size);
  constexpr double stiffness = 0.7, step = 1e-6;
  const auto energy = [&](const Places& places) {
    const Lanes energy = corner_energy(in_all_lanes(places), stiffness, frame);
    return double(energy[0]);
  };
  std::mt19937 random(9);
  std::uniform_real_distribution<double> around(-0.15, 0.15);
  int held = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Places places = at_rest();
    for (double& value : places.reshaped()) value += around(random);
    CellCorners<2> force{};
    add_corner_forces(in_all_lanes(places), stiffness, frame, force);
    held += energy(places) > 0;
    Eigen::Vector2d sum(0, 0);
    for (int i = 0; i < 8; ++i) {
      Places above = places, below = places;
      above(i % 2, i / 2) += step;
      below(i % 2, i / 2) -= step;
      const double found = force.along[i % 2][i / 2][0];
      ASSERT_NEAR(found, -(energy(above) - energy(below)) / (2 * step), 1e-5) << trial << ", " << i;
      sum[i % 2] += found;
    }
    ASSERT_LT(sum.norm(), 1e-13);
  }
  EXPECT_GT(held, 50);
  EXPECT_EQ(energy(at_rest()), 0);
  Places pressed = at_rest();
  pressed.row(0) *= 0.21;
  EXPECT_EQ(energy(pressed), 0);
}

/// Pure bending of a wall of one cell: fibres along x at distance y are strained by c y.
TEST(LocationCell, BendsWithTheStiffnessOfABeam)
{
  constexpr double c = 1e-5;
  for (int axis = 0; axis < 2; ++axis) {
    Places places = at_rest();
    for (int k = 0; k < 4; ++k) places(axis, k) += c * at_rest()(0, k) * at_rest()(1, k);
    const double length = size[axis], thickness = size[1 - axis];
    const double beam = 0.5 * elastic.in_plane_modulus(PlaneAssumption::stress) *
                        std::pow(thickness, 3) / 12 * length * c * c;
    EXPECT_NEAR(bend_to(places).energy / beam, 1, 1e-9);
  }
}

}  // namespace
}  // namespace mpm
