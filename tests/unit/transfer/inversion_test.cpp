#include <mpm/transfer/particle_faults.hpp>

#include <Eigen/LU>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

template <int Dim>
void expect_the_determinant_of_every_lane()
{
  constexpr double dt = 0.125;
  std::mt19937 random(1);
  std::uniform_real_distribution component(-10.0, 10.0);
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  alignas(lane_alignment) double gradient[Dim * Dim * lane_count];
  for (double& value : gradient) value = component(random);
  const Lanes found = step_determinant<Dim>(gradient, 1 / dt) * std::pow(dt, Dim);
  for (int lane = 0; lane < lane_count; ++lane) {
    Matrix f = Matrix::Identity();
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) f(i, j) += dt * gradient[(i + Dim * j) * lane_count + lane];
    EXPECT_NEAR(found[lane], f.determinant(), 1e-13) << "lane " << lane;
  }
}

TEST(Inversion, DeterminantIsThatOfIdentityAndStepGradient)
{
  expect_the_determinant_of_every_lane<2>();
  expect_the_determinant_of_every_lane<3>();
}

TEST(Inversion, FirstParticleIsNamedAndPaddingIsNot)
{
  ParticleStore particles({{"position", 2, "m"}, {"velocity", 2, "m/s"}},
                          {{"initial_volume", 1, "m3"}}, {});
  for (const GlobalIndex id : {7, 8}) {
    const LocalIndex p = particles.add(id);
    particles.motion()(0, p) = double(id);
    particles.motion()(3, p) = -double(id);
  }
  particles.seal();
  const auto report = [&](int inverted) {
    PassOutcome<2> outcome;
    const Lanes determinant([&](auto lane) { return int(lane) == inverted ? -2.0 : 4.0; });
    report_inverted(particles, 0, determinant, 0.5, outcome);
    return outcome.lost;
  };
  ASSERT_TRUE(report(1).has_value());
  EXPECT_EQ(report(1)->id, 8);
  EXPECT_EQ(report(1)->position, Vec<2>(8, 0));
  EXPECT_EQ(report(1)->velocity, Vec<2>(0, -8));
  EXPECT_EQ(report(1)->ratio, -0.5);
  EXPECT_EQ(report(1)->fault, Fault::inverted);
  if (lane_count > 2) {
    EXPECT_FALSE(report(2).has_value());
  }
}

}  // namespace
}  // namespace mpm
