// Paths on which one lateral stress stays zero, against closed forms and integrals of small-strain
// plasticity. Yield stress and strains are a thousandth of the cell wall's, so that rotations and
// finite strain play no part; the results are ratios.
#include <cmath>

#include "specimen.hpp"

namespace mpm {
namespace {

constexpr double small = 1e-3;
constexpr double small_yield = small * yield_stress;

/// One step in xx and shear with the yy strain that leaves no stress in yy.
void strain_with_free_edge(Specimen& specimen, double xx, double shear)
{
  const auto trial = [&](double yy) {
    Specimen copy = specimen;
    copy.strain(xx, yy, shear);
    return copy.kirchhoff()[1];
  };
  double lower = -3 * (std::abs(xx) + std::abs(shear)), upper = -lower;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (lower + upper);
    (trial(middle) < 0 ? lower : upper) = middle;
  }
  specimen.strain(xx, 0.5 * (lower + upper), shear);
}

class FreeEdge : public testing::TestWithParam<Form> {};
INSTANTIATE_TEST_SUITE_P(Forms, FreeEdge, testing::Values(Form::logarithmic, Form::rate),
                         [](const auto& info) { return form_name(info.param); });

TEST_P(FreeEdge, PlaneStrainTensionFirstYieldsAboveTheYieldStress)
{
  // sqrt(1 - nu + nu^2) sxx = sY with szz = nu sxx
  for (const auto& [ratio, yields] : {std::pair{1.13307, false}, std::pair{1.13308, true}}) {
    Specimen specimen(plastic_law(GetParam(), PlaneAssumption::strain, 0, small_yield));
    strain_with_free_edge(specimen, ratio * small_yield * (1 - 0.33 * 0.33) / 10600, 0);
    EXPECT_EQ(specimen.plastic_strain() > 0, yields) << "at " << ratio << " sY";
  }
}

TEST_P(FreeEdge, PlaneStrainTensionRisesToTheFullyPlasticStress)
{
  // Integrated to four digits; steps of 1/1000 add errors below 1e-4.
  Specimen specimen(plastic_law(GetParam(), PlaneAssumption::strain, 0, small_yield));
  int step = 0;
  for (const auto& [strain, axial, out_of_plane] :
       {std::tuple{0.06, 1.1424, 0.4254}, std::tuple{0.08, 1.1498, 0.4832},
        std::tuple{0.10, 1.1528, 0.5193}, std::tuple{0.40, 2 / std::sqrt(3), 1 / std::sqrt(3)}}) {
    for (; step < std::lround(10000 * strain); ++step)
      strain_with_free_edge(specimen, small * 1e-4, 0);
    EXPECT_NEAR(specimen.kirchhoff()[0] / small_yield, axial, 1.5e-4) << "strain " << strain;
    EXPECT_NEAR(specimen.kirchhoff()[2] / small_yield, out_of_plane, 1.5e-4);
  }
}

struct TensionAndShear {
  double shear, tension_stress, shear_stress;  // strain; of the full-size wall, MPa
};
const TensionAndShear exact[] = {
    {0.05, 403.39500, 170.56032}, {0.1, 248.84901, 250.38249}, {0.2, 76.84917, 285.24504}};

/// Tension to yield, then shear at constant axial strain, in steps.
Eigen::Vector4d tension_then_shear(Form form, double shear, int steps)
{
  Specimen specimen(plastic_law(form, PlaneAssumption::stress, 0, small_yield));
  strain_with_free_edge(specimen, small_yield / wall.youngs_modulus, 0);
  for (int k = 0; k < steps; ++k) strain_with_free_edge(specimen, 0, small * shear / steps);
  return specimen.kirchhoff() / small;
}

TEST_P(FreeEdge, ShearAfterTensionTurnsTheStressAlongTheYieldEllipse)
{
  for (const auto& [shear, tension_stress, shear_stress] : exact) {
    // First order in the step: 5.3 MPa with 10 steps (below) becomes 0.05 with 1000.
    const Eigen::Vector4d stress = tension_then_shear(GetParam(), shear, 1000);
    EXPECT_NEAR(stress[0], tension_stress, 0.25) << "shear " << shear;
    EXPECT_NEAR(stress[3], shear_stress, 0.25) << "shear " << shear;
    const double equivalent = std::hypot(stress[0], std::sqrt(3) * stress[3]);
    EXPECT_NEAR(equivalent, yield_stress, 1e-3);  // finite strain is a thousandth of a thousandth
  }
}

TEST_P(FreeEdge, ShearAfterTensionInTenStepsIsOffByTheKnownFirstOrderError)
{
  const double ten_steps[] = {405.15, 258.15, 93.65};
  for (int k = 0; k < 3; ++k) {
    const double stress = tension_then_shear(GetParam(), exact[k].shear, 10)[0];
    EXPECT_NEAR(stress, ten_steps[k], 0.02) << "shear " << exact[k].shear;
    const double finer = tension_then_shear(GetParam(), exact[k].shear, 20)[0];
    EXPECT_NEAR((stress - exact[k].tension_stress) / (finer - exact[k].tension_stress), 2, 0.25);
  }
}

}  // namespace
}  // namespace mpm
