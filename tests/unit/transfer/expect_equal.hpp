#pragma once
/// Compares what the kernels and the naive formulae made of a cloud.

#include "cloud.hpp"

namespace mpm {

template <int Dim>
Vec<Dim> momentum_of(const NodeGrid<Dim>& grid, LocalIndex node)
{
  return Eigen::Map<const Vec<Dim>>(
      &grid.fields.momentum_force[node * NodeFields<Dim>::record_width]);
}
template <int Dim>
Vec<Dim> force_of(const NodeGrid<Dim>& grid, LocalIndex node)
{
  return Eigen::Map<const Vec<Dim>>(
      &grid.fields.momentum_force[node * NodeFields<Dim>::record_width + Dim]);
}
template <int Dim>
Vec<Dim> remap_of(const NodeGrid<Dim>& grid, LocalIndex node)
{
  return Eigen::Map<const Vec<Dim>>(
      &grid.fields.remapped_momentum[node * NodeFields<Dim>::remap_width]);
}

template <int Dim>
Eigen::MatrixXd motion_of(const Cloud<Dim>& cloud, int column, int width)
{
  Eigen::MatrixXd values(width, cloud.count);
  for (int p = 0; p < cloud.count; ++p)
    for (int k = 0; k < width; ++k) values(k, p) = cloud.body.particles.motion()(column + k, p);
  return values;
}

template <int Dim>
void expect_nodes_equal(const Cloud<Dim>& cloud)
{
  for (LocalIndex i = 0; i < cloud.grid.topology.size(); ++i) {
    const NaiveNode<Dim>& node = cloud.nodes[i];
    // Sums of up to 61 terms with weights up to 1: masses and velocities of size 1, stresses of
    // size 4 with gradients of size 3.
    EXPECT_NEAR(cloud.grid.fields.mass_of(i), node.mass, 20 * rounding) << "node " << i;
    EXPECT_LT((momentum_of(cloud.grid, i) - node.momentum).norm(), 50 * rounding) << "node " << i;
    EXPECT_LT((force_of(cloud.grid, i) - node.force).norm(), 200 * rounding) << "node " << i;
  }
}

template <int Dim>
void expect_particles_equal(const Cloud<Dim>& cloud)
{
  const ColumnGroup& state = cloud.body.particles.state();
  const auto position = motion_of(cloud, 0, Dim), velocity = motion_of(cloud, Dim, Dim);
  for (int p = 0; p < cloud.count; ++p) {
    const NaiveParticle<Dim>& expected = cloud.particles[p];
    EXPECT_LT((position.col(p) - expected.x).norm(), rounding) << "particle " << p;
    EXPECT_LT((velocity.col(p) - expected.v).norm(), 10 * rounding) << "particle " << p;
    for (int k = 0; k < Dim * Dim; ++k)
      EXPECT_NEAR(state(RecordingLaw<Dim>::gradient + k, p), expected.gradient(k % Dim, k / Dim),
                  100 * rounding)
          << "particle " << p << ", column " << k;
    const int domain = cloud.body.particles.motion().find("domain");
    for (int k = 0; domain >= 0 && k < Dim * Dim; ++k)
      EXPECT_NEAR(cloud.body.particles.motion()(domain + k, p), expected.domain(k % Dim, k / Dim),
                  10 * rounding)
          << "particle " << p << ", column " << k;
    if (!cloud.naive.affine()) continue;
    const auto affine = motion_of(cloud, 2 * Dim + 1, Dim * Dim);
    for (int k = 0; k < Dim * Dim; ++k)
      EXPECT_NEAR(affine(k, p), expected.affine(k % Dim, k / Dim), 100 * rounding)
          << "particle " << p << ", column " << k;
  }
}

}  // namespace mpm
