#include <cmath>

#include "specimen.hpp"

namespace mpm {
namespace {

const double mu = wall.shear_modulus();

Specimen sheared(std::shared_ptr<const Law<2>> law, double shear, int steps)
{
  Specimen specimen(std::move(law));
  for (int k = 0; k < steps; ++k) specimen.apply(matrix(1, shear / steps, 0, 1));
  return specimen;
}

TEST(SimpleShear, OfLogarithmicElasticityHasItsClosedForm)
{
  // Steps of simple shear compose exactly: only rounding, for any number of steps.
  for (const int steps : {1, 500})
    for (const double shear : {0.5, 2.0}) {
      const Eigen::Vector4d stress =
          sheared(elastic_law(Form::logarithmic, PlaneAssumption::strain), shear, steps).cauchy();
      const double xy = 2 * mu * std::asinh(shear / 2) / std::sqrt(1 + shear * shear / 4);
      EXPECT_THAT(stress, IsNear(Eigen::Vector4d(xy * shear / 2, -xy * shear / 2, 0, xy), 1e-8));
    }
}

TEST(SimpleShear, OfLogarithmicElasticityHasTheTabulatedValues)
{
  const auto law = elastic_law(Form::logarithmic, PlaneAssumption::strain);
  EXPECT_NEAR(sheared(law, 0.5, 1).cauchy()[3], 1913.40147, 1e-5);
  EXPECT_NEAR(sheared(law, 0.5, 1).cauchy()[0], 478.35037, 1e-5);
  EXPECT_NEAR(sheared(law, 2, 1).cauchy()[3], 4967.05831, 1e-5);
  EXPECT_NEAR(sheared(law, 2, 1).cauchy()[0], 4967.05831, 1e-5);
}

TEST(SimpleShear, OfAPerfectlyPlasticMaterialEndsNearTheShearYieldStress)
{
  const Specimen specimen =
      sheared(plastic_law(Form::logarithmic, PlaneAssumption::strain), 2, 20000);
  EXPECT_NEAR(specimen.cauchy()[3], 287.918, 1e-3);
  EXPECT_LT(specimen.cauchy()[3], yield_stress / std::sqrt(3));
  EXPECT_NEAR(specimen.plastic_strain(), 1.11005, 1e-5);
}

/// Green-Naghdi rate (Dienes 1979): R turns by -b, tan b = gamma / 2, and with
/// d gamma = 2 db / cos^2 b the turning stress is t_xy = 2 mu (2 b - tan b),
/// t_xx = - t_yy = 4 mu ln cos b; then tau = R t R^T.
Eigen::Vector4d turning_shear_stress(double shear)
{
  const double b = std::atan(shear / 2), log_cos = std::log(std::cos(b));
  const double xx =
      4 * mu * (std::cos(2 * b) * log_cos + b * std::sin(2 * b) - std::sin(b) * std::sin(b));
  const double xy =
      2 * mu * (std::cos(2 * b) * (2 * b - std::tan(b)) - 2 * std::sin(2 * b) * log_cos);
  return {xx, -xx, 0, xy};
}

TEST(SimpleShear, OfTheRateFormHasTheClosedFormOfTheTurningAxes)
{
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress})
    for (const double shear : {0.1, 1.0, 4.0}) {
      const auto error = [&](int steps) {
        return (sheared(elastic_law(Form::rate, plane), shear, steps).cauchy() -
                turning_shear_stress(shear))
            .norm();
      };
      EXPECT_LT(error(1000), 1e-5 * mu) << "shear " << shear;  // second order: (4 / 1000)^2
      EXPECT_NEAR(error(50) / error(100), 4, 0.2) << "shear " << shear;
    }
}

TEST(SimpleShear, OfTheRateFormStartsWithTheShearModulus)
{
  const Eigen::Vector4d stress =
      sheared(elastic_law(Form::rate, PlaneAssumption::strain), 1e-4, 1).cauchy();
  EXPECT_NEAR(stress[3], mu * 1e-4, 1e-8 * mu);  // and terms of order gamma^2
  EXPECT_NEAR(stress[0], 0, 1e-8 * mu);
}

}  // namespace
}  // namespace mpm
