#include <cmath>
#include <numbers>

#include "specimen.hpp"

namespace mpm {
namespace {

using std::numbers::pi;

/// Wood-like constants, GPa; the axis is the grain.
constexpr TransverselyIsotropicConstants grain{10.6, 0.33, 35, 0.33, 3.5};
constexpr double printed = 6e-4;  // GPa, three decimals

Eigen::Matrix3d symmetric(double xx, double xy, double xs, double yy, double ys, double ss)
{
  Eigen::Matrix3d m;
  m << xx, xy, xs, xy, yy, ys, xs, ys, ss;
  return m;
}

TEST(IsotropicStiffness, HasLameConstantsInPlaneStrain)
{
  const auto s = PlaneStiffness::isotropic(PlaneAssumption::strain, wall);
  const double mu = wall.shear_modulus(), lambda = wall.bulk_modulus() - 2 * mu / 3;
  EXPECT_THAT(s.in_plane,
              IsNear(symmetric(lambda + 2 * mu, lambda, 0, lambda + 2 * mu, 0, mu), 1e-9));
  EXPECT_THAT(s.out_of_plane, IsNear(Eigen::RowVector3d(lambda, lambda, 0), 1e-9));
  EXPECT_NEAR(s.in_plane(0, 0), 15705.440071, 1e-6);
}

TEST(IsotropicStiffness, HasYoungsModulusOverOneMinusNuSquaredInPlaneStress)
{
  const auto s = PlaneStiffness::isotropic(PlaneAssumption::stress, wall);
  const double e = wall.youngs_modulus, nu = wall.poisson_ratio, c = e / (1 - nu * nu);
  EXPECT_THAT(s.in_plane, IsNear(symmetric(c, nu * c, 0, c, 0, wall.shear_modulus()), 1e-9));
  EXPECT_THAT(s.thickness_strain, IsNear(Eigen::RowVector3d(-nu / e, -nu / e, 0), 1e-18));
}

TEST(TransverselyIsotropicStiffness, WithTheAxisOutOfPlane)
{
  const auto strain = PlaneStiffness::axis_out_of_plane(PlaneAssumption::strain, grain);
  EXPECT_THAT(strain.in_plane, IsNear(symmetric(12.759, 4.789, 0, 12.759, 0, 3.985), printed));
  // sigma_zz = nu_A (sigma_xx + sigma_yy), without a ratio of moduli
  const Eigen::RowVector3d sum = strain.in_plane.row(0) + strain.in_plane.row(1);
  EXPECT_THAT(strain.out_of_plane, IsNear(Eigen::RowVector3d(0.33 * sum), 1e-12));

  // In plane stress the constants along the axis do not enter the plane.
  const auto stress = PlaneStiffness::axis_out_of_plane(PlaneAssumption::stress, grain);
  const auto isotropic = PlaneStiffness::isotropic(PlaneAssumption::stress, {10.6, 0.33});
  EXPECT_THAT(stress.in_plane, IsNear(isotropic.in_plane, 1e-12));
  EXPECT_THAT(stress.thickness_strain,
              IsNear(Eigen::RowVector3d(-0.33 / 35, -0.33 / 35, 0), 1e-15));
}

TEST(TransverselyIsotropicStiffness, WithTheAxisInThePlane)
{
  EXPECT_THAT(PlaneStiffness::axis_in_plane(PlaneAssumption::strain, grain, 0).in_plane,
              IsNear(symmetric(38.822, 5.791, 0, 12.759, 0, 3.5), printed));
  EXPECT_THAT(PlaneStiffness::axis_in_plane(PlaneAssumption::stress, grain, 0).in_plane,
              IsNear(symmetric(36.194, 3.617, 0, 10.962, 0, 3.5), printed));
}

TEST(TransverselyIsotropicStiffness, WithTheAxisAtThirtyDegrees)
{
  EXPECT_THAT(PlaneStiffness::axis_in_plane(PlaneAssumption::strain, grain, pi / 6).in_plane,
              IsNear(symmetric(27.432, 10.666, 8.457, 14.400, 2.828, 8.375), printed));
}

TEST(TransverselyIsotropicStiffness, WithTheAxisAtNinetyDegreesExchangesXAndY)
{
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    const auto at_0 = PlaneStiffness::axis_in_plane(plane, grain, 0);
    const auto at_90 = PlaneStiffness::axis_in_plane(plane, grain, pi / 2);
    EXPECT_NEAR(at_90.in_plane(0, 0), at_0.in_plane(1, 1), 1e-12);
    EXPECT_NEAR(at_90.in_plane(1, 1), at_0.in_plane(0, 0), 1e-12);
    EXPECT_NEAR(at_90.out_of_plane(0), at_0.out_of_plane(1), 1e-12);
    EXPECT_NEAR(at_90.thickness_strain(0), at_0.thickness_strain(1), 1e-12);
  }
}

TEST(TransverselyIsotropicStiffness, OfEqualConstantsIsIsotropicAtAnyAngle)
{
  const TransverselyIsotropicConstants equal{10600, 0.33, 10600, 0.33, wall.shear_modulus()};
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    const auto isotropic = PlaneStiffness::isotropic(plane, wall);
    for (const double angle : {0.0, 0.4, 2.0}) {
      const auto s = PlaneStiffness::axis_in_plane(plane, equal, angle);
      EXPECT_THAT(s.in_plane, IsNear(isotropic.in_plane, 1e-8));
      EXPECT_THAT(s.out_of_plane, IsNear(isotropic.out_of_plane, 1e-8));
      EXPECT_THAT(s.thickness_strain, IsNear(isotropic.thickness_strain, 1e-16));
    }
  }
}

TEST(WaveModulus, IsThatOfThePWave)
{
  EXPECT_NEAR(PlaneStiffness::isotropic(PlaneAssumption::strain, wall).wave_modulus(),
              wall.wave_modulus(), 1e-8);
  // Along the grain, found among directions 1 degree apart.
  EXPECT_NEAR(PlaneStiffness::axis_in_plane(PlaneAssumption::strain, grain, pi / 6).wave_modulus(),
              38.822, printed);
}

TEST(WaveSpeed, OfTheCellWallIs3236MetresPerSecondInPlaneStrainAnd2816InPlaneStress)
{
  constexpr IsotropicConstants pascal{10.6e9, 0.33};
  for (const auto& [plane, speed] :
       {std::pair{PlaneAssumption::strain, 3236.0}, std::pair{PlaneAssumption::stress, 2816.0}}) {
    EXPECT_NEAR(make_hencky(plane, pascal, 1500, std::nullopt)->wave_speed(), speed, 0.5);
    EXPECT_NEAR(make_hencky(plane, pascal, 1500, YieldConstants{1e8})->wave_speed(), speed, 0.5);
    EXPECT_NEAR(
        make_hypoelastic(plane, PlaneStiffness::isotropic(plane, pascal), 1500)->wave_speed(),
        speed, 0.5);
    EXPECT_NEAR(make_hypoelastic_von_mises(plane, pascal, {1e8}, 1500)->wave_speed(), speed, 0.5);
  }
}

TEST(WaveSpeed, AcrossTheGrainIsLowerThanTheIsotropicOneInPlaneStrain)
{
  const TransverselyIsotropicConstants pascal{10.6e9, 0.33, 35e9, 0.33, 3.5e9};
  const auto stiffness = PlaneStiffness::axis_out_of_plane(PlaneAssumption::strain, pascal);
  EXPECT_NEAR(make_hypoelastic(PlaneAssumption::strain, stiffness, 1500)->wave_speed(), 2917, 0.5);
}

}  // namespace
}  // namespace mpm
