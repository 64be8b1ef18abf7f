#include <cmath>
#include <numbers>

#include "specimen.hpp"

namespace mpm {
namespace {

class EnergyBalance : public EveryLaw {};
INSTANTIATE_TEST_SUITE_P(Laws, EnergyBalance, every_law(), law_name);

/// Closed at t = 1, with strains up to 20 % and rotations; not proportional.
Eigen::Matrix2d closed_path(double t)
{
  const double a = std::sin(2 * std::numbers::pi * t), b = 1 - std::cos(2 * std::numbers::pi * t);
  return matrix(1 - 0.08 * b, 0.1 * a, 0.03 * b, 1 + 0.12 * a);
}

struct Ledger {
  double stress_power = 0, elastic_energy = 0, plastic_work = 0;
  double imbalance() const { return std::abs(stress_power - elastic_energy - plastic_work); }
};

constexpr double volume = 2e-3;

/// Stress power V0 tau : D with the mean stress of a step and the midpoint gradient.
Ledger follow(std::shared_ptr<const Law<2>> law, bool yields, double end, int steps)
{
  Specimen specimen(std::move(law), volume);
  Ledger ledger;
  Eigen::Vector4d old = specimen.kirchhoff();
  for (int k = 1; k <= steps; ++k) {
    const Eigen::Matrix2d before = specimen.deformation(), after = closed_path(end * k / steps);
    specimen.apply(after * before.inverse());
    const Eigen::Matrix2d g = (after - before) * (0.5 * (after + before)).inverse();
    const Eigen::Vector4d tau = 0.5 * (old + specimen.kirchhoff());
    ledger.stress_power +=
        volume * (tau[0] * g(0, 0) + tau[1] * g(1, 1) + tau[3] * (g(0, 1) + g(1, 0)));
    old = specimen.kirchhoff();
    if (yields) {
      const double work = specimen.column("plastic_work");
      EXPECT_GE(work, ledger.plastic_work) << "dissipation is never negative, step " << k;
      ledger.plastic_work = work;
    }
  }
  ledger.elastic_energy = specimen.elastic_energy();
  return ledger;
}

TEST_P(EnergyBalance, OfAnElasticPathClosesToSecondOrderInTheStep)
{
  for (const double end : {0.4, 1.0}) {
    const auto law = elastic_law(form(), plane());
    const double scale = follow(law, false, 0.4, 400).elastic_energy;
    ASSERT_GT(scale, 0.1);
    EXPECT_LT(follow(law, false, end, 400).imbalance(), 1e-3 * scale);
    EXPECT_GT(follow(law, false, end, 200).imbalance(),
              3.5 * follow(law, false, end, 400).imbalance());
  }
}

TEST_P(EnergyBalance, OfAPlasticPathClosesToFirstOrderInTheStep)
{
  for (const double hardening : {0.0, 1000.0})
    for (const double end : {0.4, 1.0}) {
      const auto law = plastic_law(form(), plane(), hardening);
      const Ledger coarse = follow(law, true, end, 400), fine = follow(law, true, end, 800);
      ASSERT_GT(fine.plastic_work, 0.01);
      EXPECT_LT(fine.imbalance(), 0.01 * fine.plastic_work);
      EXPECT_GT(coarse.imbalance(), 1.7 * fine.imbalance());
    }
}

TEST(LogarithmicForm, AfterAClosedElasticCycleIsFreeOfStressAndEnergy)
{
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    Specimen specimen(elastic_law(Form::logarithmic, plane));
    for (int k = 1; k <= 100; ++k)
      specimen.apply(closed_path(k / 100.0) * specimen.deformation().inverse());
    EXPECT_LT(specimen.cauchy().norm(), 1e-9);  // after 100 roundings of 1e3 MPa
    EXPECT_LT(specimen.elastic_energy(), 1e-18);
  }
}

TEST_P(EnergyBalance, PlasticWorkOfPerfectPlasticityIsYieldStressTimesPlasticStrain)
{
  Specimen specimen(plastic_law(form(), plane()), volume);
  for (int k = 1; k <= 50; ++k)
    specimen.apply(closed_path(k / 50.0) * specimen.deformation().inverse());
  ASSERT_GT(specimen.plastic_strain(), 0.1);
  EXPECT_NEAR(specimen.column("plastic_work"), volume * yield_stress * specimen.plastic_strain(),
              1e-12);
}

TEST_P(EnergyBalance, ElasticEnergyOfASmallStrainIsHalfStressTimesStrain)
{
  Specimen specimen(elastic_law(form(), plane()), volume);
  specimen.strain(2e-6, -1e-6, 3e-6);
  const Eigen::Vector4d s = specimen.cauchy();
  const double half = 0.5 * volume * (s[0] * 2e-6 - s[1] * 1e-6 + s[3] * 3e-6);
  EXPECT_NEAR(specimen.elastic_energy(), half, 1e-5 * half);  // strains of 1e-6 are not zero
}

}  // namespace
}  // namespace mpm
