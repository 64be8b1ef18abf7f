#include <cmath>
#include <numbers>

#include "specimen.hpp"

namespace mpm {
namespace {

using std::numbers::pi;

class Objectivity : public EveryLaw {};
INSTANTIATE_TEST_SUITE_P(Laws, Objectivity, every_law(), law_name);

constexpr double rounding = 1e-9;  // MPa: 1e-12 of stresses of 1e3

TEST_P(Objectivity, TenTurnsAfterLoadingLeaveTheStressInTheTurningAxes)
{
  // In steps of 30 degrees; a step of I + dt L with L from the rotation itself is exact.
  for (const bool yields : {false, true}) {
    Specimen specimen(yields ? plastic_law(form(), plane()) : elastic_law(form(), plane()));
    specimen.apply(matrix(0.97, 0.02, 0.01, 1.01));
    const Eigen::Vector4d before = specimen.cauchy();
    const double energy = specimen.elastic_energy();
    ASSERT_GT(before.norm(), 100);
    for (int step = 1; step <= 121; ++step) {
      specimen.apply(rotation(pi / 6));
      ASSERT_THAT(specimen.cauchy(), IsNear(turned(before, rotation(step * pi / 6)), rounding))
          << "step " << step;
    }
    EXPECT_NEAR(specimen.elastic_energy(), energy, 1e-11 * energy);
  }
}

TEST_P(Objectivity, ARotationOfAStressFreeBodyMakesNoStress)
{
  Specimen specimen(plastic_law(form(), plane()));
  for (int step = 0; step < 12; ++step) specimen.apply(rotation(-1));
  EXPECT_LT(specimen.cauchy().norm(), rounding);
  EXPECT_EQ(specimen.plastic_strain(), 0);
}

TEST(LogarithmicForm, OneStepWithASuperposedRotationIsTheRotatedStep)
{
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    const Eigen::Matrix2d f = matrix(0.85, 0.10, 0.05, 1.02), r = rotation(0.7);
    Specimen plain(plastic_law(Form::logarithmic, plane, 1000));
    Specimen rotated(plastic_law(Form::logarithmic, plane, 1000));
    plain.apply(f);
    rotated.apply(r * f);
    EXPECT_THAT(rotated.cauchy(), IsNear(turned(plain.cauchy(), r), rounding));
    EXPECT_NEAR(rotated.plastic_strain(), plain.plastic_strain(), 1e-13);
  }
}

/// Stretch and shear into the plastic range while everything turns by `angle`; returned in axes
/// that turn with it.
Eigen::Vector4d loaded_while_turning(std::shared_ptr<const Law<2>> law, double angle, int steps)
{
  Specimen specimen(std::move(law));
  for (int k = 1; k <= steps; ++k) {
    const double t = double(k) / steps;
    const Eigen::Matrix2d f =
        rotation(angle * t) * matrix(1 - 0.2 * t, 0.1 * t * t, 0.05 * t, 1 + 0.1 * std::sin(t));
    specimen.apply(f * specimen.deformation().inverse());
  }
  return turned(specimen.cauchy(), rotation(-angle));
}

TEST_P(Objectivity, LoadingWhileTurningTendsToLoadingAtRest)
{
  for (const bool yields : {false, true}) {
    const auto law = yields ? plastic_law(form(), plane(), 1000) : elastic_law(form(), plane());
    const auto difference = [&](int steps) {
      return (loaded_while_turning(law, 2, steps) - loaded_while_turning(law, 0, steps)).norm();
    };
    if (form() == Form::logarithmic) {
      EXPECT_LT(difference(10), rounding);  // objective step by step
    } else {
      EXPECT_LT(difference(1000), 0.1);  // MPa, of 1e3
      EXPECT_GT(difference(100) / difference(200), 3.5) << "second order";
    }
  }
}

}  // namespace
}  // namespace mpm
