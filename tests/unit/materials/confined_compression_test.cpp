// Uniaxial strain, where stresses follow from formulae at any strain. The deviator keeps its
// direction, so that the return map is exact for any number of steps: only rounding is left.
#include <cmath>

#include "specimen.hpp"

namespace mpm {
namespace {

using Eigen::Vector4d;

const double mu = wall.shear_modulus(), bulk = wall.bulk_modulus();
constexpr double rounding = 1e-8;  // MPa, of stresses up to 1e4 after 100 steps

Specimen compressed(std::shared_ptr<const Law<2>> law, double stretch, int steps)
{
  Specimen specimen(std::move(law));
  for (int k = 0; k < steps; ++k) specimen.apply(matrix(std::pow(stretch, 1.0 / steps), 0, 0, 1));
  return specimen;
}

TEST(ConfinedCompression, IsElasticUpToYieldAndThenFollowsTheBulkModulus)
{
  for (const int steps : {1, 50}) {
    Specimen specimen(plastic_law(Form::rate, PlaneAssumption::strain));
    for (int k = 0; k < steps; ++k) specimen.strain(0.1 / steps, 0, 0);
    EXPECT_THAT(specimen.kirchhoff(),
                IsNear(Vector4d(bulk * 0.1 + 2 * yield_stress / 3, bulk * 0.1 - yield_stress / 3,
                                bulk * 0.1 - yield_stress / 3, 0),
                       rounding));
    EXPECT_NEAR(specimen.kirchhoff()[0], 1372.549, 1e-3);
    EXPECT_NEAR(specimen.plastic_strain(), 2.0 / 3 * (0.1 - yield_stress / (2 * mu)), 1e-13);
  }
}

TEST(ConfinedCompression, YieldsAtTheStrainWhereTheStressDifferenceIsTheYieldStress)
{
  const double strain = yield_stress / (2 * mu);
  EXPECT_NEAR(strain, 0.0627358, 1e-7);
  Specimen before(plastic_law(Form::rate, PlaneAssumption::strain));
  before.strain(-strain * (1 - 1e-6), 0, 0);
  EXPECT_EQ(before.plastic_strain(), 0);
  EXPECT_NEAR(before.kirchhoff()[0], -985.294, 2e-3);
  Specimen after(plastic_law(Form::rate, PlaneAssumption::strain));
  after.strain(-strain * (1 + 1e-6), 0, 0);
  EXPECT_GT(after.plastic_strain(), 0);
}

TEST(ConfinedCompression, StiffensToAnyDensityInTheLogarithmicForm)
{
  for (const int steps : {1, 100}) {
    for (const auto& [stretch, cauchy, plastic_strain] :
         {std::tuple{0.9, -1586.9515, 0.0284164}, std::tuple{0.5, -15073.2551, 0.4202742}}) {
      const Specimen specimen =
          compressed(plastic_law(Form::logarithmic, PlaneAssumption::strain), stretch, steps);
      EXPECT_NEAR(specimen.cauchy()[0], (bulk * std::log(stretch) - 2 * yield_stress / 3) / stretch,
                  rounding);
      EXPECT_NEAR(specimen.cauchy()[0], cauchy, 1e-4);
      EXPECT_NEAR(specimen.plastic_strain(), plastic_strain, 1e-7);
    }
  }
}

TEST(ConfinedCompression, OfElasticMaterialIsThePWaveModulusTimesTheLogarithmOfTheStretch)
{
  for (const double stretch : {0.02, 0.5, 0.8, 1.3})
    EXPECT_NEAR(compressed(elastic_law(Form::logarithmic, PlaneAssumption::strain), stretch, 10)
                    .cauchy()[0],
                wall.wave_modulus() * std::log(stretch) / stretch, 1e-12 * 3e6)  // up to 3e6 MPa
        << "stretch " << stretch;
}

TEST(ConfinedCompression, OfTheRateFormTendsToTheSameStressWithSmallSteps)
{
  // The midpoint strain of a step of relative size e is ln(1 + e) up to e^3 / 12: second order.
  const double exact = wall.wave_modulus() * std::log(0.5) / 0.5;
  const auto error = [&](int steps) {
    return std::abs(
        compressed(elastic_law(Form::rate, PlaneAssumption::strain), 0.5, steps).cauchy()[0] -
        exact);
  };
  EXPECT_NEAR(error(50) / error(100), 4, 0.05);
  EXPECT_LT(error(100), 1e-5 * std::abs(exact));
}

TEST(ConfinedCompression, HardensByTheHardeningModulus)
{
  // q = 2 mu eps - 3 mu ep = sY + H ep, eps the strain along the axis.
  constexpr double hardening = 1000, strain = 0.2;
  for (const Form form : {Form::logarithmic, Form::rate}) {
    Specimen specimen(plastic_law(form, PlaneAssumption::strain, hardening));
    for (int k = 0; k < 20; ++k)
      if (form == Form::rate)
        specimen.strain(strain / 20, 0, 0);
      else
        specimen.apply(matrix(std::exp(strain / 20), 0, 0, 1));
    const double expected = (2 * mu * strain - yield_stress) / (3 * mu + hardening);
    EXPECT_NEAR(specimen.plastic_strain(), expected, 1e-13);
    const Vector4d tau = specimen.kirchhoff();
    EXPECT_NEAR(tau[0] - tau[1], yield_stress + hardening * expected, rounding);
  }
}

}  // namespace
}  // namespace mpm
