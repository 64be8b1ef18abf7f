#include <mpm/materials/present_deformation.hpp>

#include <cmath>

#include "specimen.hpp"

namespace mpm {
namespace {

/// Particles with the deformation gradients `states`, each reached in many steps so that the rate
/// form follows the logarithm.
Body<2> body_of(Form form, const std::vector<Eigen::Matrix2d>& states,
                const IsotropicConstants& elastic = wall)
{
  std::unique_ptr<Law<2>> law;
  if (form == Form::logarithmic)
    law = make_hencky(PlaneAssumption::strain, elastic, density, std::nullopt);
  else
    law = make_hypoelastic(PlaneAssumption::strain,
                           PlaneStiffness::isotropic(PlaneAssumption::strain, elastic), density);
  ParticleStore particles({}, law->state_columns(), {"initial_volume"});
  Body<2> body{"block", 0, density, std::move(law), std::move(particles)};
  ColumnGroup& state = body.particles.state();
  const int volume = state.find("initial_volume");
  for (std::size_t k = 0; k < states.size(); ++k) {
    const LocalIndex particle = body.particles.add(GlobalIndex(k));
    state(volume, particle) = 1e-3 * double(k + 1);
    body.law->initialise(state, particle);
  }
  body.particles.seal();
  constexpr int steps = 400;
  constexpr double dt = 1.0 / 1024;
  for (int s = 0; s < steps; ++s)
    for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
      alignas(lane_alignment) double gradient[4 * lane_count] = {}, force[3 * lane_count];
      for (int lane = 0; lane < lane_count; ++lane) {
        const std::size_t p = std::size_t(b) * lane_count + lane;
        if (p >= states.size()) continue;
        const auto at = [&](double part) -> Eigen::Matrix2d {
          return Eigen::Matrix2d::Identity() + part * (states[p] - Eigen::Matrix2d::Identity());
        };
        const Eigen::Matrix2d f = at(double(s + 1) / steps) * at(double(s) / steps).inverse();
        for (int k = 0; k < 4; ++k)
          gradient[k * lane_count + lane] = (f(k % 2, k / 2) - (k % 3 == 0)) / dt;
      }
      body.law->update(state.block(b), 1, gradient, dt, force);
    }
  return body;
}

double speed(Form form, const std::vector<Eigen::Matrix2d>& states)
{
  return present_deformation(body_of(form, states)).wave_speed;
}

class PresentWaveSpeed : public testing::TestWithParam<Form> {};
INSTANTIATE_TEST_SUITE_P(Forms, PresentWaveSpeed, testing::Values(Form::logarithmic, Form::rate),
                         [](const auto& info) { return form_name(info.param); });

const double p_modulus = wall.wave_modulus();

TEST_P(PresentWaveSpeed, IsTheLawsOwnWithoutStressAndInTension)
{
  const double own = std::sqrt(p_modulus / density);
  EXPECT_NEAR(speed(GetParam(), {matrix(1, 0, 0, 1)}), own, 1e-12 * own);
  EXPECT_NEAR(speed(GetParam(), {matrix(1.3, 0, 0, 1.2)}), own, 1e-12 * own);
}

/// One that shears what is drawn to `stretch`, along it: the slope of the nominal shear stress by
/// the gradient of its motion, by central differences.
double transverse_speed(const IsotropicConstants& elastic, double stretch)
{
  const auto shear_stress = [&](double gradient) {
    Eigen::Matrix2d f;
    f << stretch, 0, gradient, 1;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> squared(f * f.transpose());
    const Eigen::Matrix2d strain =
        squared.eigenvectors() * (0.5 * squared.eigenvalues().array().log()).matrix().asDiagonal() *
        squared.eigenvectors().transpose();
    const double mu = elastic.shear_modulus(), lambda = elastic.wave_modulus() - 2 * mu;
    const Eigen::Matrix2d tau =
        2 * mu * strain + lambda * strain.trace() * Eigen::Matrix2d::Identity();
    return (tau * f.inverse().transpose())(1, 0);
  };
  constexpr double h = 1e-6;
  const double slope = (shear_stress(h) - shear_stress(-h)) / (2 * h);
  return stretch * std::sqrt(slope / density);
}

TEST_P(PresentWaveSpeed, IsNotBelowThatOfATransverseWaveAlongWhatIsDrawn)
{
  const IsotropicConstants cork{1e9, 0};
  const double own = std::sqrt(cork.wave_modulus() / density);
  bool matters = false;
  for (const double stretch : {1.5, 2.0, 3.0, 4.0}) {
    const double transverse = transverse_speed(cork, stretch);
    matters = matters || transverse > 1.2 * own;
    const double found =
        present_deformation(body_of(GetParam(), {matrix(stretch, 0, 0, 1)}, cork)).wave_speed;
    EXPECT_NEAR(found, std::max(own, transverse), 1e-3 * own) << stretch;
  }
  EXPECT_TRUE(matters);
}

TEST_P(PresentWaveSpeed, FollowsTheTangentOfConfinedCompression)
{
  // P = M ln(F) / F: the slope of the nominal stress, by central differences.
  for (const double f : {0.9, 0.5, 0.2}) {
    const auto nominal = [](double g) { return p_modulus * std::log(g) / g; };
    const double h = 1e-6, slope = (nominal(f + h) - nominal(f - h)) / (2 * h);
    const double expected = std::sqrt(f * f * slope / density);
    EXPECT_NEAR(speed(GetParam(), {matrix(f, 0, 0, 1)}), expected, 1e-4 * expected) << "F = " << f;
  }
}

TEST_P(PresentWaveSpeed, DoesNotDependOnTheDirection)
{
  const Eigen::Matrix2d q = rotation(0.7), f = matrix(0.6, 0, 0, 1.1);
  const double along_axes = speed(GetParam(), {f});
  EXPECT_GT(along_axes, 1.1 * std::sqrt(p_modulus / density));
  EXPECT_NEAR(speed(GetParam(), {q * f * q.transpose()}), along_axes, 1e-6 * along_axes);
}

TEST_P(PresentWaveSpeed, IsThatOfTheFastestParticle)
{
  std::vector<Eigen::Matrix2d> states(2 * lane_count + 1, matrix(1, 0, 0, 1));
  states[lane_count + 1] = matrix(0.5, 0, 0, 1);
  EXPECT_DOUBLE_EQ(speed(GetParam(), states), speed(GetParam(), {matrix(0.5, 0, 0, 1)}));
}

}  // namespace
}  // namespace mpm
