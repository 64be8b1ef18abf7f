// The logarithmic form in space on paths with exact answers, and beside the plane law.
#include <cmath>
#include <random>

#include "material_point.hpp"
#include "solid_specimen.hpp"

namespace mpm {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const double mu = wall.shear_modulus(), bulk = wall.bulk_modulus();
constexpr double rounding = 1e-9;  // MPa: 1e-12 of stresses of 1e3

MaterialPoint<3> solid(std::optional<YieldConstants> yield = {}, double volume = 1)
{
  return MaterialPoint<3>(make_hencky_solid(wall, density, yield), volume);
}

Matrix3d deviator(const Matrix3d& t)
{
  return t - t.trace() / 3 * Matrix3d::Identity();
}
double von_mises(const Matrix3d& t)
{
  return std::sqrt(1.5) * deviator(t).norm();
}
Matrix3d diagonal(double x, double y, double z)
{
  return Vector3d(x, y, z).asDiagonal();
}
Matrix3d random_rotation(std::mt19937& random)
{
  std::uniform_real_distribution component(-1.0, 1.0);
  return rotation_about(Vector3d(component(random), component(random), component(random)),
                        3 * component(random));
}

TEST(SolidLogarithmicForm, TheStressOfAnyStretchIsHookesLawOfItsLogarithm)
{
  // Stretches from 0.2 to 5: all apart, two equal, two or all nearly equal, all small. The
  // logarithm of the b_e that the law holds is taken in long double, so that all but its own error
  // is left: to 1e-12 of the strain, and to the rounding of b, which in the trace counts 3 K / mu =
  // 8 times.
  using Wide = Eigen::Matrix<long double, 3, 3>;
  std::mt19937 random(1);
  std::uniform_real_distribution logarithm(std::log(0.2), std::log(5.0));
  for (int k = 0; k < 4000; ++k) {
    Vector3d e(logarithm(random), logarithm(random), logarithm(random));
    const double near = std::pow(10, -1 - 14 * std::abs(logarithm(random)) / std::log(5.0));
    if (k % 8 == 1) e[1] = e[0];
    if (k % 8 == 2) e[1] = e[0] * (1 + near);
    if (k % 8 == 3) e = Vector3d(e[0], e[0] * (1 + near), e[0] * (1 - near));
    if (k % 8 == 4) e = near * e;
    if (k % 8 == 5) e = Vector3d::Constant(e[0]) + 0.1 * e;
    if (k % 8 == 6) e = 0.04 * e;
    const Matrix3d q = random_rotation(random);
    MaterialPoint<3> point = solid();
    point.apply(q * e.array().exp().matrix().asDiagonal() * q.transpose() *
                random_rotation(random));
    const Eigen::SelfAdjointEigenSolver<Wide> spectrum(
        point.symmetric_columns("elastic_left_cauchy_green").cast<long double>());
    const Wide strain = spectrum.eigenvectors() *
                        (0.5L * spectrum.eigenvalues().array().log()).matrix().asDiagonal() *
                        spectrum.eigenvectors().transpose();
    const long double trace = strain.trace();
    const Wide expected =
        2 * mu * (strain - trace / 3 * Wide::Identity()) + bulk * trace * Wide::Identity();
    const double error = double((point.kirchhoff().cast<long double>() - expected).norm()) / mu;
    EXPECT_LT(error, 1e-12 * e.norm() + 4e-15) << "logarithms of the stretches " << e.transpose();
  }
}

TEST(SolidLogarithmicForm, ConfinedCompressionStiffensToAnyDensity)
{
  for (const double stretch : {0.02, 0.5, 0.8, 1.3}) {
    MaterialPoint<3> point = solid();
    for (int k = 0; k < 10; ++k) point.apply(diagonal(1, std::pow(stretch, 0.1), 1));
    const Matrix3d s = point.cauchy();
    EXPECT_NEAR(s(1, 1), wall.wave_modulus() * std::log(stretch) / stretch, 1e-12 * 3e6);
    EXPECT_NEAR(s(0, 0), (bulk - 2.0 / 3 * mu) * std::log(stretch) / stretch, 1e-12 * 3e6);
    EXPECT_NEAR(s(2, 2), s(0, 0), 1e-12 * 3e6);
  }
}

TEST(SolidLogarithmicForm, ConfinedCompressionPastYieldFollowsTheBulkModulus)
{
  // The deviator keeps its direction: exact for any number of steps.
  for (const int steps : {1, 100})
    for (const double stretch : {0.9, 0.5}) {
      MaterialPoint<3> point = solid(YieldConstants{yield_stress});
      for (int k = 0; k < steps; ++k) point.apply(diagonal(1, 1, std::pow(stretch, 1.0 / steps)));
      EXPECT_NEAR(point.kirchhoff()(2, 2), bulk * std::log(stretch) - 2 * yield_stress / 3, 1e-8);
      EXPECT_NEAR(point.column("plastic_strain"),
                  2.0 / 3 * (-std::log(stretch) - yield_stress / (2 * mu)), 1e-12);
      EXPECT_NEAR(point.column("plastic_work"), yield_stress * point.column("plastic_strain"),
                  1e-9);
    }
}

TEST(SolidLogarithmicForm, UniaxialStressIsYoungsModulusThenTheElasticPlasticTangent)
{
  // tau_xx = E e up to yield; beyond, tau_xx = sY + H ep with e = tau_xx / E + ep, and across
  // e = -nu tau_xx / E - ep / 2.
  constexpr double hardening = 1000;
  const double modulus = wall.youngs_modulus, nu = wall.poisson_ratio;
  MaterialPoint<3> point = solid(YieldConstants{yield_stress, hardening});
  constexpr int steps = 60;
  Vector3d old = Vector3d::Zero();
  for (int k = 1; k <= steps; ++k) {
    const double strain = 0.3 * k / steps;
    const double plastic = std::max(0.0, (modulus * strain - yield_stress) / (modulus + hardening));
    const double tau = modulus * (strain - plastic);
    const double across = -nu * tau / modulus - plastic / 2;
    const Vector3d e(strain, across, across);
    point.apply((e - old).array().exp().matrix().asDiagonal());
    old = e;
    // The step in which yielding begins is returned along its end, not its way: exact all the same,
    // because the deviator does not turn.
    EXPECT_THAT(point.kirchhoff(), IsNearTensor(diagonal(tau, 0, 0), rounding))
        << "strain " << strain;
    EXPECT_NEAR(point.column("plastic_strain"), plastic, 1e-13);
  }
  EXPECT_GT(point.column("plastic_strain"), 0.2);
}

TEST(SolidLogarithmicForm, SimpleShearHasItsClosedFormInEveryPlane)
{
  // b of simple shear has the stretches exp(+-a), sinh a = gamma / 2, in axes at half the angle
  // whose tangent is 2 / gamma: tau_ij = 2 mu a / cosh a, tau_ii = - tau_jj = 2 mu a tanh a.
  for (int i = 0; i < 3; ++i)
    for (const double gamma : {1e-3, 0.2, 3.0}) {
      const int j = (i + 1) % 3;
      Matrix3d step = Matrix3d::Identity();
      step(i, j) = gamma / 7;
      MaterialPoint<3> point = solid();
      for (int k = 0; k < 7; ++k) point.apply(step);
      const double a = std::asinh(gamma / 2);
      Matrix3d expected = Matrix3d::Zero();
      expected(i, j) = expected(j, i) = 2 * mu * a / std::cosh(a);
      expected(i, i) = 2 * mu * a * std::tanh(a);
      expected(j, j) = -expected(i, i);
      EXPECT_THAT(point.kirchhoff(), IsNearTensor(expected, rounding)) << "plane " << i;
    }
}

TEST(SolidLogarithmicForm, PlaneMotionsGiveTheStressOfThePlaneLaw)
{
  for (const double hardening : {-1.0, 0.0, 1000.0}) {
    const auto yield = hardening < 0 ? std::nullopt : std::optional(YieldConstants{200, hardening});
    MaterialPoint<3> point = solid(yield, 2);
    Specimen plane(hardening < 0
                       ? elastic_law(Form::logarithmic, PlaneAssumption::strain)
                       : plastic_law(Form::logarithmic, PlaneAssumption::strain, hardening, 200),
                   2);
    std::mt19937 random(2);
    std::uniform_real_distribution component(-0.04, 0.04);
    for (int k = 0; k < 60; ++k) {
      const Eigen::Matrix2d f = rotation(0.3) * (Eigen::Matrix2d::Identity() +
                                                 matrix(component(random) - 0.01, component(random),
                                                        component(random), component(random)));
      plane.apply(f);
      point.apply(in_space(f, 1));
      const Eigen::Vector4d tau = plane.kirchhoff();
      ASSERT_THAT(
          point.kirchhoff(),
          IsNearTensor(in_space(matrix(tau[0], tau[3], tau[3], tau[1]), tau[2]), 10 * rounding))
          << "step " << k;
      ASSERT_NEAR(point.elastic_energy(), plane.elastic_energy(), 1e-11 * plane.elastic_energy());
    }
    if (!yield) continue;
    EXPECT_GT(plane.plastic_strain(), 0.1);
    EXPECT_NEAR(point.column("plastic_strain"), plane.plastic_strain(), 1e-11);
    EXPECT_NEAR(point.column("plastic_work"), plane.column("plastic_work"), 1e-8);
  }
}

TEST(SolidLogarithmicForm, AfterAClosedElasticWayItIsFreeOfStressAndEnergy)
{
  std::mt19937 random(3);
  std::uniform_real_distribution component(-0.3, 0.3);
  MaterialPoint<3> point = solid();
  for (int k = 0; k < 30; ++k)
    point.go_to(Matrix3d::Identity() + Matrix3d::NullaryExpr([&] { return component(random); }), 3);
  ASSERT_GT(point.cauchy().norm(), 100);
  point.go_to(Matrix3d::Identity(), 3);
  EXPECT_LT(point.cauchy().norm(), 100 * rounding);  // the rounding of 93 steps
  EXPECT_LT(point.elastic_energy(), 1e-15);
}

TEST(SolidLogarithmicForm, FlowKeepsTheVolumeAndEndsOnTheYieldSurface)
{
  // Large steps too: the trial strain is out of reach of the series, the returned one is not.
  std::mt19937 random(4);
  std::uniform_real_distribution component(-0.6, 0.6);
  for (int k = 0; k < 200; ++k) {
    MaterialPoint<3> point = solid(YieldConstants{k % 2 ? 100.0 : 4000.0, 500});
    Matrix3d f = Matrix3d::Identity() + Matrix3d::NullaryExpr([&] { return component(random); });
    if (f.determinant() < 0.1) continue;
    point.apply(f);
    if (point.column("plastic_strain") == 0) continue;
    const Matrix3d tau = point.kirchhoff();
    const double flow_stress = (k % 2 ? 100 : 4000) + 500 * point.column("plastic_strain");
    EXPECT_NEAR(von_mises(tau), flow_stress, 1e-9 * flow_stress);
    EXPECT_NEAR(tau.trace() / 3, bulk * std::log(f.determinant()), 1e-11 * bulk);
    EXPECT_LT((point.force() - tau).norm(), 1e-10 * tau.norm());  // b_e holds the returned strain
  }
}

}  // namespace
}  // namespace mpm
