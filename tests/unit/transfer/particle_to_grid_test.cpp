#include <algorithm>
#include <numeric>

#include "expect_equal.hpp"

namespace mpm {
namespace {

class ParticleToGrid : public TransferTest {};
INSTANTIATE_TEST_SUITE_P(All, ParticleToGrid,
                         testing::Combine(testing::ValuesIn(all_of_list<ShapeRow>()),
                                          testing::ValuesIn(all_of_list<SchemeRow>())),
                         case_name);

template <int Dim>
void compare_with_the_double_loop(TransferCase c)
{
  Cloud<Dim> cloud(c);
  cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, true);
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  expect_nodes_equal(cloud);
}

TEST_P(ParticleToGrid, EqualsTheDoubleLoopOverParticlesAndNodes)
{
  compare_with_the_double_loop<2>(parameters());
  compare_with_the_double_loop<3>(parameters());
}

template <int Dim>
void expect_conservation(TransferCase c)
{
  Cloud<Dim> cloud(c);
  cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, true);
  double mass = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero(), force = Vec<Dim>::Zero();
  for (LocalIndex i = 0; i < cloud.grid.topology.size(); ++i) {
    mass += cloud.grid.fields.mass_of(i);
    momentum += momentum_of(cloud.grid, i);
    force += force_of(cloud.grid, i);
  }
  for (const NaiveParticle<Dim>& p : cloud.particles) {
    mass -= p.mass;
    momentum -= p.mass * p.v;  // the affine parts have no momentum: sum w (x_i - x_p) = 0
  }
  EXPECT_NEAR(mass, 0, 100 * rounding);
  EXPECT_LT(momentum.norm(), 100 * rounding);
  EXPECT_LT(force.norm(), 1000 * rounding);  // of terms of size 10
}

TEST_P(ParticleToGrid, ConservesMassAndMomentumAndItsInternalForcesSumToZero)
{
  expect_conservation<2>(parameters());
  expect_conservation<3>(parameters());
}

template <int Dim>
void expect_the_same_in_any_order(TransferCase c)
{
  Cloud<Dim> cloud(c);
  std::vector<LocalIndex> first, order(cloud.count);
  cloud.transfer->first_nodes(cloud.body.particles, cloud.grid.topology, first);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](LocalIndex p) { return first[p]; });
  ASSERT_FALSE(std::ranges::is_sorted(first));
  cloud.body.particles.permute(order);
  cloud.body.particles.seal();
  cloud.transfer->first_nodes(cloud.body.particles, cloud.grid.topology, first);
  ASSERT_TRUE(std::ranges::is_sorted(first));
  cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, true);
  cloud.naive.to_grid(cloud.particles, cloud.nodes);  // still in the old order
  expect_nodes_equal(cloud);
}

TEST_P(ParticleToGrid, GivesTheSameSumsForSortedParticles)
{
  expect_the_same_in_any_order<2>(parameters());
  expect_the_same_in_any_order<3>(parameters());
}

template <int Dim>
void expect_stencils_to_cover_all_weights(TransferCase c)
{
  Cloud<Dim> cloud(c);
  std::vector<LocalIndex> first;
  cloud.transfer->first_nodes(cloud.body.particles, cloud.grid.topology, first);
  ASSERT_EQ(int(first.size()), cloud.count);
  for (int p = 0; p < cloud.count; ++p) {
    double covered = 0;
    for (LocalIndex node = 0; node < cloud.grid.topology.size(); ++node) {
      bool inside = true;
      for (int d = 0; d < Dim; ++d) {
        const LocalIndex count = cloud.grid.topology.local().count()[d];
        const LocalIndex k = node / cloud.grid.topology.stride(d) % count -
                             first[p] / cloud.grid.topology.stride(d) % count;
        inside = inside && k >= 0 && k < cloud.transfer->support();
      }
      if (inside) covered += cloud.naive.weight(cloud.particles[p], cloud.nodes[node]);
    }
    EXPECT_NEAR(covered, 1, rounding) << "particle " << p;
  }
}

TEST_P(ParticleToGrid, StencilsFromTheFirstNodeCoverAllWeights)
{
  expect_stencils_to_cover_all_weights<2>(parameters());
  expect_stencils_to_cover_all_weights<3>(parameters());
}

template <int Dim>
void expect_no_force(TransferCase c)
{
  Cloud<Dim> cloud(c);
  cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, false);
  for (auto& p : cloud.particles) p.stress.setZero();
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  expect_nodes_equal(cloud);
}

TEST_P(ParticleToGrid, WithoutForceLeavesTheForcesZero)
{
  expect_no_force<2>(parameters());
  expect_no_force<3>(parameters());
}

template <int Dim>
void compare_forces_from_outside(TransferCase c)
{
  Cloud<Dim> cloud(c);
  std::vector<Vec<Dim>> force(cloud.count);
  for (Vec<Dim>& f : force) f = cloud.template numbers<Dim, 1>();
  cloud.transfer->outside_force(cloud.body, cloud.grid.topology,
                                cloud.grid.fields.load_force_column(),
                                [&](LocalIndex block, Lanes(&values)[Dim]) {
                                  for (int d = 0; d < Dim; ++d)
                                    values[d] = Lanes([&](int lane) {
                                      const int p = block * lane_count + lane;
                                      return p < cloud.count ? force[p][d] : 0.0;
                                    });
                                  return true;
                                });
  for (std::size_t i = 0; i < cloud.nodes.size(); ++i) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (int p = 0; p < cloud.count; ++p)
      sum += cloud.naive.weight(cloud.particles[p], cloud.nodes[i]) * force[p];
    const Eigen::Map<const Vec<Dim>> found(&cloud.grid.fields.load_force[i * Dim]);
    EXPECT_LT((found - sum).norm(), 50 * rounding) << "node " << i;
  }
}

TEST_P(ParticleToGrid, OfForcesFromOutsideEqualsTheDoubleLoop)
{
  compare_forces_from_outside<2>(parameters());
  compare_forces_from_outside<3>(parameters());
}

template <int Dim>
void put_particles_on_grid_lines(OneOf<ShapeRow> shape)
{
  Cloud<Dim> cloud({shape, "flip"});
  for (int p = 0; p < cloud.count; ++p)
    for (int d = 0; d < Dim; ++d)
      cloud.particles[p].x[d] =
          cloud.grid.topology.geometry().node_position(d, cloud.local().lower[d] + 3) +
          0.5 * cloud.grid.topology.geometry().spacing[d] * ((p >> d) % 2);
  cloud.fill_body();
  cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, false);
  for (auto& p : cloud.particles) p.stress.setZero();  // their gradients jump there
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  expect_nodes_equal(cloud);
}

TEST(ParticleToGridOnGridLines, EqualsTheDoubleLoop)
{
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>()) {
    put_particles_on_grid_lines<2>(shape);
    put_particles_on_grid_lines<3>(shape);
  }
}

}  // namespace
}  // namespace mpm
