// Divergences averaged around the nodes, against the plain sums.
#include "expect_equal.hpp"

namespace mpm {
namespace {

class FBar : public TransferTest {};
INSTANTIATE_TEST_SUITE_P(All, FBar,
                         testing::Combine(testing::ValuesIn(all_of_list<ShapeRow>()),
                                          testing::ValuesIn(all_of_list<SchemeRow>())),
                         case_name);

constexpr double dt = 0.02;

/// Of the particles' own velocity gradients, which a step without averages leaves in the law.
template <int Dim>
std::vector<Matrix<Dim>> own_gradients(Cloud<Dim>& cloud)
{
  cloud.naive.stress_update(cloud.nodes, cloud.particles, dt);
  std::vector<Matrix<Dim>> gradients;
  for (const NaiveParticle<Dim>& p : cloud.particles) gradients.push_back(p.gradient);
  return gradients;
}

template <int Dim>
void expect_averages(TransferCase c)
{
  Cloud<Dim> cloud(c, true, true);
  auto& fields = cloud.grid.fields;
  const auto runs = cloud.grid.topology.runs();
  cloud.transfer->prime(cloud.body, cloud.grid.topology, fields, false);
  cloud.set_random_velocities();
  const std::vector<Matrix<Dim>> own = own_gradients(cloud);

  std::vector<double> mass(cloud.nodes.size()), sum(cloud.nodes.size());
  const auto weight = [&](std::size_t p, std::size_t i) {
    return cloud.naive.weight(cloud.particles[p], cloud.nodes[i]);
  };
  for (std::size_t p = 0; p < own.size(); ++p)
    for (std::size_t i = 0; i < mass.size(); ++i) {
      mass[i] += weight(p, i) * cloud.particles[p].mass;
      sum[i] += weight(p, i) * cloud.particles[p].mass * own[p].trace();
    }

  fields.reset_remap(runs);
  cloud.transfer->divergence(cloud.body, cloud.grid.topology, fields);
  fields.divergence_from_remap(runs);
  cloud.transfer->usf_stress(cloud.body, cloud.grid.topology, fields, dt);
  const ColumnGroup& state = cloud.body.particles.state();
  double changed = 0;
  for (std::size_t p = 0; p < own.size(); ++p) {
    double averaged = 0;
    for (std::size_t i = 0; i < mass.size(); ++i)
      if (mass[i] > 0) averaged += weight(p, i) * sum[i] / mass[i];
    const Matrix<Dim> expected =
        own[p] + (averaged - own[p].trace()) / Dim * Matrix<Dim>::Identity();
    changed = std::max(changed, (expected - own[p]).norm());
    for (int k = 0; k < Dim * Dim; ++k)
      ASSERT_NEAR(state(RecordingLaw<Dim>::gradient + k, LocalIndex(p)), expected(k % Dim, k / Dim),
                  100 * rounding)
          << "particle " << p << ", column " << k;
  }
  EXPECT_GT(changed, 0.1);
}

TEST_P(FBar, GradientsHaveTheMeanDivergenceAroundTheirNodes)
{
  expect_averages<2>(parameters());
  expect_averages<3>(parameters());
}

/// What the stress sees is no motion of the particle's corners.
template <int Dim>
void expect_domains_to_move_with_their_own_gradients()
{
  Cloud<Dim> cloud({"cpdi", "flip"}, true, true);
  auto& fields = cloud.grid.fields;
  cloud.transfer->prime(cloud.body, cloud.grid.topology, fields, false);
  cloud.set_random_velocities();
  const std::vector<Matrix<Dim>> own = own_gradients(cloud);
  fields.reset_remap(cloud.grid.topology.runs());
  cloud.transfer->divergence(cloud.body, cloud.grid.topology, fields);
  fields.divergence_from_remap(cloud.grid.topology.runs());
  cloud.transfer->musl_stress(cloud.body, cloud.grid.topology, fields, dt, cloud.wide_bounds());
  const ColumnGroup& motion = cloud.body.particles.motion();
  const int domain = motion.find("domain");
  for (std::size_t p = 0; p < own.size(); ++p) {
    const Matrix<Dim> before = cloud.particles[p].domain;
    const Matrix<Dim> expected = before + dt * own[p] * before;
    for (int k = 0; k < Dim * Dim; ++k)
      ASSERT_NEAR(motion(domain + k, LocalIndex(p)), expected(k % Dim, k / Dim), 100 * rounding)
          << "particle " << p << ", column " << k;
  }
}

TEST(FBarBesideDomains, LeavesTheirMotionAlone)
{
  expect_domains_to_move_with_their_own_gradients<2>();
  expect_domains_to_move_with_their_own_gradients<3>();
}

}  // namespace
}  // namespace mpm
