// The rate form in space on paths with exact answers, under rotation, and beside the plane law.
#include <cmath>

#include "solid_specimen.hpp"

namespace mpm {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const double mu = wall.shear_modulus(), bulk = wall.bulk_modulus();
constexpr double rounding = 1e-9;  // MPa: 1e-12 of stresses of 1e3

const Matrix3d small_strain =
    (Matrix3d() << -0.03, 0.01, 0.02, 0.01, 0.02, -0.015, 0.02, -0.015, 0.01).finished();

Matrix3d deviator(const Matrix3d& t)
{
  return t - t.trace() / 3 * Matrix3d::Identity();
}
double von_mises(const Matrix3d& t)
{
  return std::sqrt(1.5) * deviator(t).norm();
}

TEST(SolidRateForm, StrainWithoutSpinIsAnsweredByHookesLawForAnyNumberOfSteps)
{
  const Matrix3d expected =
      2 * mu * deviator(small_strain) + bulk * small_strain.trace() * Matrix3d::Identity();
  for (const int steps : {1, 50}) {
    SolidSpecimen specimen;
    for (int k = 0; k < steps; ++k) specimen.strain(small_strain / steps);
    EXPECT_THAT(specimen.kirchhoff(), IsNearTensor(expected, rounding)) << steps << " steps";
  }
}

TEST(SolidRateForm, CauchyStressIsKirchhoffStressOverTheVolumeRatioAndForceIsTimesTheVolume)
{
  SolidSpecimen specimen({}, 3);
  const Matrix3d f = Matrix3d::Identity() + small_strain;
  specimen.apply(f);
  EXPECT_NEAR(specimen.column("volume_ratio"), f.determinant(), 1e-15);
  EXPECT_THAT(specimen.cauchy(),
              IsNearTensor((specimen.kirchhoff() / f.determinant()).eval(), rounding));
  EXPECT_THAT(specimen.force(), IsNearTensor((3 * specimen.kirchhoff()).eval(), rounding));
}

TEST(SolidRateForm, ProportionalLoadingReturnsRadiallyToTheExactStress)
{
  // The deviator keeps its direction n: q = 3 mu e - 3 mu ep = sY + H ep with e the equivalent
  // strain, so that any number of steps ends at the same stress.
  const double equivalent = std::sqrt(2.0 / 3) * deviator(small_strain).norm();
  for (const double hardening : {0.0, 1000.0})
    for (const int steps : {1, 40}) {
      SolidSpecimen specimen(YieldConstants{100, hardening}, 2);
      for (int k = 0; k < steps; ++k) specimen.strain(small_strain / steps);
      const double plastic = (3 * mu * equivalent - 100) / (3 * mu + hardening);
      ASSERT_GT(plastic, 0.01);
      EXPECT_NEAR(specimen.column("plastic_strain"), plastic, 1e-14 * steps);
      EXPECT_NEAR(von_mises(specimen.kirchhoff()), 100 + hardening * plastic, rounding);
      const Matrix3d expected =
          2.0 / 3 * (100 + hardening * plastic) / equivalent * deviator(small_strain) +
          bulk * small_strain.trace() * Matrix3d::Identity();
      EXPECT_THAT(specimen.kirchhoff(), IsNearTensor(expected, rounding));
      if (hardening > 0) continue;
      EXPECT_NEAR(specimen.column("plastic_work"), 2 * 100 * plastic, 1e-11);
    }
}

TEST(SolidRateForm, YieldsWhereTheVonMisesStressReachesTheYieldStress)
{
  const double limit = 3 * mu * std::sqrt(2.0 / 3) * deviator(small_strain).norm();
  SolidSpecimen below(YieldConstants{limit * (1 + 1e-9)}),
      above(YieldConstants{limit * (1 - 1e-9)});
  below.strain(small_strain);
  above.strain(small_strain);
  EXPECT_EQ(below.column("plastic_strain"), 0);
  EXPECT_GT(above.column("plastic_strain"), 0);
}

TEST(SolidRateForm, ARigidSpinTurnsTheStressAndKeepsItsInvariantsAndEnergy)
{
  for (const bool yields : {false, true}) {
    SolidSpecimen specimen(yields ? std::optional(YieldConstants{100}) : std::nullopt);
    specimen.strain(small_strain);
    const Matrix3d before = specimen.cauchy();
    const double energy = specimen.elastic_energy();
    Matrix3d turn = Matrix3d::Identity();
    for (int step = 1; step <= 60; ++step) {
      const Matrix3d r = rotation_about(Vector3d(std::sin(step), 0.5, std::cos(2.0 * step)), 0.7);
      specimen.apply(r);
      turn = r * turn;
      ASSERT_THAT(specimen.cauchy(),
                  IsNearTensor((turn * before * turn.transpose()).eval(), rounding))
          << "step " << step;
    }
    EXPECT_NEAR(specimen.cauchy().trace(), before.trace(), rounding);
    EXPECT_NEAR(von_mises(specimen.cauchy()), von_mises(before), rounding);
    EXPECT_NEAR(specimen.cauchy().determinant(), before.determinant(), 1e6 * rounding);  // MPa^3
    EXPECT_NEAR(specimen.elastic_energy(), energy, 1e-11 * energy);
    EXPECT_NEAR(
        specimen.column("volume_ratio"),
        (Matrix3d::Identity() + (Matrix3d::Identity() - small_strain / 2).inverse() * small_strain)
            .determinant(),
        1e-13);
  }
}

TEST(SolidRateForm, SimpleShearHasTheClosedFormOfTheJaumannRate)
{
  // Dienes 1979: tau_xy = mu sin gamma, tau_xx = - tau_yy = mu (1 - cos gamma); in every plane.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const auto error = [&](int steps) {
      constexpr double gamma = 2;
      Matrix3d step = Matrix3d::Identity();
      step(i, j) = gamma / steps;
      SolidSpecimen specimen;
      for (int k = 0; k < steps; ++k) specimen.apply(step);
      Matrix3d expected = Matrix3d::Zero();
      expected(i, j) = expected(j, i) = mu * std::sin(gamma);
      expected(i, i) = mu * (1 - std::cos(gamma));
      expected(j, j) = -expected(i, i);
      return (specimen.kirchhoff() - expected).norm();
    };
    EXPECT_NEAR(error(50) / error(100), 4, 0.1) << "second order, plane " << i;
    EXPECT_LT(error(1000), 1e-5 * mu);
  }
}

TEST(SolidRateForm, AgreesWithPlaneStrainWherePrincipalAxesStayInTheMaterial)
{
  // Stretches along axes at 25 degrees, and between them rotations of all into new directions: the
  // turning rate and the Jaumann rate are the same there.
  for (const double hardening : {-1.0, 0.0, 1000.0}) {
    const auto yield = hardening < 0 ? std::nullopt : std::optional(YieldConstants{200, hardening});
    SolidSpecimen solid(yield, 2);
    Specimen plane(hardening < 0 ? elastic_law(Form::rate, PlaneAssumption::strain)
                                 : plastic_law(Form::rate, PlaneAssumption::strain, hardening, 200),
                   2);
    double turned_by = 0;
    for (int k = 0; k < 30; ++k) {
      const Eigen::Matrix2d r = rotation(25 * M_PI / 180 + turned_by);
      const Eigen::Matrix2d stretch =
          r * matrix(1 - 0.004 * std::cos(0.3 * k), 0, 0, 1 + 0.002 * k / 10) * r.transpose();
      const Eigen::Matrix2d turn = rotation(0.4);
      turned_by += 0.4;
      for (const Eigen::Matrix2d& f : {stretch, turn}) {
        plane.apply(f);
        solid.apply(in_space(f, 1));
      }
      const Eigen::Vector4d tau = plane.kirchhoff();
      ASSERT_THAT(solid.kirchhoff(),
                  IsNearTensor(in_space(matrix(tau[0], tau[3], tau[3], tau[1]), tau[2]), rounding))
          << "step " << k;
      ASSERT_NEAR(solid.elastic_energy(), plane.elastic_energy(), 1e-11 * plane.elastic_energy());
    }
    if (!yield) continue;
    EXPECT_GT(plane.plastic_strain(), 0.01);
    EXPECT_NEAR(solid.column("plastic_strain"), plane.plastic_strain(), 1e-13);
    EXPECT_NEAR(solid.column("plastic_work"), plane.column("plastic_work"), 1e-10);
  }
}

TEST(SolidRateForm, TheStepIsTheSameInEveryOrderOfTheAxes)
{
  // x, y, z to y, z, x: a slip in one component of six shows.
  const Matrix3d f =
      Matrix3d::Identity() +
      (Matrix3d() << -0.05, 0.02, 0.01, -0.03, 0.04, 0.06, 0.02, -0.01, 0.03).finished();
  Matrix3d p = Matrix3d::Zero();
  p(1, 0) = p(2, 1) = p(0, 2) = 1;
  SolidSpecimen plain(YieldConstants{300, 500}), permuted(YieldConstants{300, 500});
  for (int k = 0; k < 5; ++k) {
    plain.apply(f);
    permuted.apply(p * f * p.transpose());
  }
  EXPECT_GT(plain.column("plastic_strain"), 0.01);
  EXPECT_THAT(permuted.cauchy(),
              IsNearTensor((p * plain.cauchy() * p.transpose()).eval(), rounding));
}

TEST(SolidRateForm, AFreshParticleIsFreeOfStressAndTheWaveSpeedIsThatOfPWaves)
{
  const SolidSpecimen fresh(YieldConstants{100});
  EXPECT_EQ(fresh.cauchy().norm(), 0);
  EXPECT_EQ(fresh.elastic_energy(), 0);
  EXPECT_DOUBLE_EQ(make_hypoelastic_solid(wall, density, {})->wave_speed(),
                   std::sqrt(wall.wave_modulus() / density));
}

TEST(SolidRateForm, AVelocityThatIsNoNumberShowsInTheStress)
{
  for (const auto& yield : {std::optional<YieldConstants>{}, std::optional(YieldConstants{100})}) {
    SolidSpecimen specimen(yield);
    Matrix3d f = Matrix3d::Identity();
    f(0, 2) = std::nan("");
    specimen.apply(f);
    EXPECT_TRUE(specimen.cauchy().hasNaN());
  }
}

}  // namespace
}  // namespace mpm
