// What every law promises to the step and to the output.
#include <cmath>
#include <limits>
#include <random>

#include "specimen.hpp"

namespace mpm {
namespace {

class LawInterface : public EveryLaw {};
INSTANTIATE_TEST_SUITE_P(Laws, LawInterface, every_law(), law_name);

constexpr double dt = 1.0 / 1024;

/// A body of `count` particles, sealed, with one random gradient per lane and block.
struct Crowd {
  std::shared_ptr<const Law<2>> law;
  ParticleStore particles;
  LaneVector<double> gradient, force;

  Crowd(std::shared_ptr<const Law<2>> the_law, int count)
      : law(std::move(the_law)),
        particles({{"position", 2, "m"}}, law->state_columns(), {"initial_volume", "plastic_work"})
  {
    for (int p = 0; p < count; ++p) {
      particles.add(p);
      law->initialise(particles.state(), p);
      particles.state()(0, p) = 1 + p;
    }
    particles.seal();
    std::mt19937 random(9);
    std::uniform_real_distribution rate(-0.1, 0.1);
    gradient.resize(particles.blocks() * 4 * lane_count);
    for (double& g : gradient) g = rate(random) / dt;
    force.resize(particles.blocks() * 3 * lane_count);
  }
  void update()
  {
    law->update(particles.state().block(0), particles.blocks(), gradient.data(), dt, force.data());
  }
  Eigen::Matrix2d increment(int particle) const
  {
    const double* l = &gradient[(particle / lane_count) * 4 * lane_count + particle % lane_count];
    return Eigen::Matrix2d::Identity() +
           dt * matrix(l[0], l[2 * lane_count], l[lane_count], l[3 * lane_count]);
  }
};

constexpr int count = 2 * lane_count + 1;  // the last block is nearly empty

TEST_P(LawInterface, EveryLaneOfEveryBlockIsAParticleOfItsOwn)
{
  // Gradients differ from lane to lane: some yield, some do not.
  const auto law = plastic_law(form(), plane(), 1000);
  Crowd crowd(law, count);
  crowd.update();
  crowd.update();
  int yielding = 0;
  const int plastic_strain = crowd.particles.state().find("plastic_strain");
  for (int p = 0; p < count; ++p) {
    Specimen alone(law, 1 + p);
    alone.apply(crowd.increment(p));
    alone.apply(crowd.increment(p));
    const Eigen::Vector4d tau = alone.kirchhoff() * (1 + p);
    const double* force = &crowd.force[(p / lane_count) * 3 * lane_count + p % lane_count];
    const double tolerance = 1e-9 * (1 + p);  // V0 tau of 1e3 MPa
    EXPECT_NEAR(force[0], tau[0], tolerance) << "particle " << p;
    EXPECT_NEAR(force[lane_count], tau[1], tolerance) << "particle " << p;
    EXPECT_NEAR(force[2 * lane_count], tau[3], tolerance) << "particle " << p;
    EXPECT_NEAR(crowd.particles.state()(plastic_strain, p), alone.plastic_strain(), 1e-13);
    yielding += alone.plastic_strain() > 0;
  }
  EXPECT_GT(yielding, 0);
}

TEST_P(LawInterface, PaddingLanesGiveNoForceNoEnergyAndNoPlasticWork)
{
  const auto law = plastic_law(form(), plane());
  Crowd crowd(law, count);
  for (int k = 0; k < 5; ++k) crowd.update();
  const LocalIndex last = crowd.particles.blocks() - 1;
  const Lanes energy = law->elastic_energy(crowd.particles.state().block(last));
  const int work = crowd.particles.state().find("plastic_work");
  for (int lane = 1; lane < lane_count; ++lane) {
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(crowd.force[(last * 3 + c) * lane_count + lane], 0) << "lane " << lane;
    EXPECT_EQ(energy[lane], 0) << "lane " << lane;
    EXPECT_EQ(crowd.particles.state()(work, last * lane_count + lane), 0) << "lane " << lane;
  }
  EXPECT_GT(energy[0], 0);
}

TEST_P(LawInterface, ForceStressWithoutAnUpdateIsThatOfTheLastUpdate)
{
  const auto law = plastic_law(form(), plane());
  Crowd crowd(law, count);
  crowd.update();
  LaneVector<double> again(crowd.force.size());
  law->force_stress(crowd.particles.state().block(0), crowd.particles.blocks(), again.data());
  for (std::size_t k = 0; k < again.size(); ++k)
    EXPECT_NEAR(again[k], crowd.force[k], 1e-9 * count);  // through exp and log of the state
}

TEST_P(LawInterface, AFreshParticleIsFreeOfStressAndEnergy)
{
  for (const auto& law : {elastic_law(form(), plane()), plastic_law(form(), plane())}) {
    const Specimen specimen(law);
    EXPECT_EQ(specimen.cauchy().norm(), 0);
    EXPECT_EQ(specimen.elastic_energy(), 0);
    EXPECT_EQ(law->state_columns().front().name, "initial_volume");
  }
}

TEST_P(LawInterface, AVelocityThatIsNoNumberShowsInForceAndStress)
{
  // The logarithm in lanes reads bits, and turns NaN into a number: it must show all the same.
  for (const auto& law : {elastic_law(form(), plane()), plastic_law(form(), plane())}) {
    Specimen specimen(law);
    specimen.apply(matrix(1, std::numeric_limits<double>::quiet_NaN(), 0, 1));
    EXPECT_TRUE(std::isnan(specimen.kirchhoff()[0]));
    EXPECT_TRUE(std::isnan(specimen.cauchy()[0]));
  }
}

TEST(PlaneStress, CauchyStressIsKirchhoffStressOverTheVolumeRatioWithTheThickness)
{
  // Uniaxial stress: F = diag(a, a^-nu), thickness a^-nu too, tau = E ln a.
  constexpr int steps = 1000;  // the rate form takes ln a as a sum: second order
  const double a = 0.8, nu = wall.poisson_ratio;
  const double tau = wall.youngs_modulus * std::log(a);
  for (const Form form : {Form::logarithmic, Form::rate}) {
    Specimen specimen(elastic_law(form, PlaneAssumption::stress));
    for (int k = 0; k < steps; ++k)
      specimen.apply(matrix(std::pow(a, 1.0 / steps), 0, 0, std::pow(a, -nu / steps)));
    EXPECT_NEAR(specimen.kirchhoff()[0], tau, 1e-4);
    EXPECT_NEAR(specimen.kirchhoff()[1], 0, 1e-4);
    EXPECT_NEAR(specimen.cauchy()[0], tau / std::pow(a, 1 - 2 * nu), 1e-4);
  }
}

TEST_P(LawInterface, StressOutOfThePlaneIsNuTimesTheSumInElasticPlaneStrainAndZeroInPlaneStress)
{
  Specimen specimen(elastic_law(form(), plane()));
  specimen.apply(matrix(0.9, 0.05, -0.02, 1.04));
  const Eigen::Vector4d s = specimen.cauchy();
  const double expected =
      plane() == PlaneAssumption::strain ? wall.poisson_ratio * (s[0] + s[1]) : 0;
  EXPECT_NEAR(s[2], expected, 1e-9);
}

}  // namespace
}  // namespace mpm
