// Single steps far into the plastic range. The expected numbers (MPa) come from return maps in
// three dimensions, evaluated independently; their last printed digit sets the tolerance.
#include <cmath>

#include "specimen.hpp"

namespace mpm {
namespace {

using Eigen::Vector4d;

constexpr double printed_stress = 1e-5;  // MPa, five decimals
constexpr double printed_strain = 1e-9;

struct OneStep {
  double hardening;
  Vector4d stress;
  double plastic_strain;
};

class OneStepOfStrain : public testing::TestWithParam<Form> {
 protected:
  /// exx = -0.08, eyy = 0.02, gxy = 0.05, as midpoint or as logarithmic strain.
  Specimen strained(const std::shared_ptr<const Law<2>>& law) const
  {
    Specimen specimen(law);
    if (GetParam() == Form::rate)
      specimen.strain(-0.08, 0.02, 0.05);
    else
      specimen.apply(exponential(matrix(-0.08, 0.025, 0.025, 0.02)));
    return specimen;
  }
};
INSTANTIATE_TEST_SUITE_P(Forms, OneStepOfStrain, testing::Values(Form::logarithmic, Form::rate),
                         [](const auto& info) { return form_name(info.param); });

TEST_P(OneStepOfStrain, InPlaneStrainReturnsToTheYieldSurface)
{
  for (const OneStep& expected :
       {OneStep{0, {-919.48759, -426.22396, -524.87669, 123.31591}, 0.025753217},
        OneStep{1000, {-933.55466, -416.84592, -520.18766, 129.17719}, 0.023765302}}) {
    const Specimen specimen =
        strained(plastic_law(GetParam(), PlaneAssumption::strain, expected.hardening));
    EXPECT_THAT(specimen.kirchhoff(), IsNear(expected.stress, printed_stress));
    EXPECT_NEAR(specimen.plastic_strain(), expected.plastic_strain, printed_strain);
  }
}

TEST_P(OneStepOfStrain, InPlaneStressReturnsToTheYieldSurface)
{
  for (const OneStep& expected :
       {OneStep{0, {-503.93345, -87.55495, 0, 104.09463}, 0.038231466},
        OneStep{1000, {-537.05334, -89.18464, 0, 111.96717}, 0.034876832}}) {
    const Specimen specimen =
        strained(plastic_law(GetParam(), PlaneAssumption::stress, expected.hardening));
    EXPECT_THAT(specimen.kirchhoff(), IsNear(expected.stress, printed_stress));
    EXPECT_NEAR(specimen.plastic_strain(), expected.plastic_strain, printed_strain);
  }
}

TEST(RateForm, InPlaneStressThickensByItsElasticAndItsPlasticStrain)
{
  for (const auto& [hardening, thickness_strain] :
       {std::pair{0.0, 0.041027730}, std::pair{1000.0, 0.039913122}}) {
    Specimen specimen(plastic_law(Form::rate, PlaneAssumption::stress, hardening));
    specimen.strain(-0.08, 0.02, 0.05);
    EXPECT_NEAR(specimen.column("thickness_strain"), thickness_strain, printed_strain);
  }
}

const Eigen::Matrix2d large_step = matrix(0.85, 0.10, 0.05, 1.02);

TEST(LogarithmicForm, OneLargeElasticStepInPlaneStrain)
{
  Specimen specimen(elastic_law(Form::logarithmic, PlaneAssumption::strain));
  specimen.apply(large_step);
  EXPECT_THAT(specimen.cauchy(),
              IsNear(Vector4d(-2843.29786, -1194.96439, -1332.62654, 767.34596), printed_stress));
}

TEST(LogarithmicForm, OneLargePlasticStepInPlaneStrain)
{
  for (const OneStep& expected :
       {OneStep{0, {-2085.68797, -1623.29168, -1661.90915, 215.25858}, 0.107268416},
        OneStep{1000, {-2144.16859, -1590.22869, -1636.49151, 257.87473}, 0.098988265}}) {
    Specimen specimen(plastic_law(Form::logarithmic, PlaneAssumption::strain, expected.hardening));
    specimen.apply(large_step);
    EXPECT_THAT(specimen.cauchy(), IsNear(expected.stress, printed_stress));
    EXPECT_NEAR(specimen.plastic_strain(), expected.plastic_strain, printed_strain);
  }
}

TEST(LogarithmicForm, CarriesTheElasticStretchOutOfThePlane)
{
  Specimen specimen(plastic_law(Form::logarithmic, PlaneAssumption::strain));
  specimen.apply(large_step);
  EXPECT_NEAR(std::exp(2 * specimen.column("elastic_log_strain_zz")), 0.931249379, printed_strain);
}

TEST_P(OneStepOfStrain, AStressInsideTheYieldSurfaceIsElastic)
{
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    Specimen plastic(plastic_law(GetParam(), plane, 0, 5000));
    Specimen elastic(elastic_law(GetParam(), plane));
    for (Specimen* specimen : {&plastic, &elastic}) specimen->apply(large_step);
    EXPECT_THAT(plastic.cauchy(), IsNear(elastic.cauchy(), 1e-9));  // rounding of 1e3 MPa
    EXPECT_EQ(plastic.plastic_strain(), 0);
    EXPECT_EQ(plastic.column("plastic_work"), 0);
  }
}

}  // namespace
}  // namespace mpm
