// Refinements of the grid's velocity (FMPM, XPIC) against the series with full matrices.
#include <Eigen/Dense>

#include "expect_equal.hpp"

namespace mpm {
namespace {

std::vector<OneOf<SchemeRow>> refining_schemes()
{
  std::vector<OneOf<SchemeRow>> list;
  for (const OneOf<SchemeRow> scheme : all_of_list<SchemeRow>())
    if (scheme->refines) list.push_back(scheme);
  return list;
}

class Refinement : public TransferTest {};
INSTANTIATE_TEST_SUITE_P(All, Refinement,
                         testing::Combine(testing::ValuesIn(all_of_list<ShapeRow>()),
                                          testing::ValuesIn(refining_schemes())),
                         case_name);

/// S and S+ of the cloud: weights of particles' positions at nodes, and the lumped way back.
template <int Dim>
struct Mapping {
  Eigen::MatrixXd to_particles, to_nodes;

  explicit Mapping(const Cloud<Dim>& cloud)
      : to_particles(cloud.particles.size(), cloud.nodes.size()),
        to_nodes(cloud.nodes.size(), cloud.particles.size())
  {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(Eigen::Index(cloud.nodes.size()));
    for (std::size_t p = 0; p < cloud.particles.size(); ++p)
      for (std::size_t i = 0; i < cloud.nodes.size(); ++i) {
        const double w = cloud.naive.weight(cloud.particles[p], cloud.nodes[i]);
        to_particles(p, i) = w;
        to_nodes(i, p) = w * cloud.particles[p].mass;
        mass[i] += to_nodes(i, p);
      }
    for (Eigen::Index i = 0; i < mass.size(); ++i)
      if (mass[i] > 0) to_nodes.row(i) /= mass[i];
  }
};

template <int Dim>
Eigen::MatrixXd updated_velocities(NodeFields<Dim>& fields, std::size_t nodes)
{
  Eigen::MatrixXd v(nodes, Dim);
  for (std::size_t i = 0; i < nodes; ++i)
    for (int d = 0; d < Dim; ++d) v(i, d) = fields.updated_of(LocalIndex(i))[d];
  return v;
}

template <int Dim>
void expect_series(TransferCase c)
{
  Cloud<Dim> cloud(c, true);
  auto& fields = cloud.grid.fields;
  const auto runs = cloud.grid.topology.runs();
  cloud.transfer->prime(cloud.body, cloud.grid.topology, fields, false);
  fields.update_velocity(runs, 0);
  const Mapping<Dim> map(cloud);
  const Eigen::MatrixXd before = updated_velocities(fields, cloud.nodes.size());
  for (std::size_t i = 0; i < cloud.nodes.size(); ++i)
    for (int d = 0; d < Dim; ++d)
      fields.force_of(LocalIndex(i))[d] = fields.mass_of(LocalIndex(i)) * (0.3 * d - 0.01 * i);
  fields.update_velocity(runs, 1);
  const Eigen::MatrixXd first = updated_velocities(fields, cloud.nodes.size());
  ASSERT_GT((first - before).norm(), 0.1 * before.norm());
  const bool before_forces = c.scheme->refines_before_forces;
  Eigen::MatrixXd expected = first, residual = before_forces ? before : first;
  fields.begin_refinement(runs, before_forces);
  for (int k = 0; k < 3; ++k) {
    fields.reset_remap(runs);
    cloud.transfer->refine_velocity(cloud.body, cloud.grid.topology, fields);
    fields.refine(runs);
    fields.end_refinement(runs);
    residual -= map.to_nodes * (map.to_particles * residual);
    expected += residual;
    const Eigen::MatrixXd found = updated_velocities(fields, cloud.nodes.size());
    ASSERT_LT((found - expected).norm(), 1e-11 * expected.norm()) << "refinement " << k + 1;
    ASSERT_GT((found - first).norm(), 1e-3 * first.norm());
  }
}

TEST_P(Refinement, IsTheSeriesOfTheFullMassMatrix)
{
  expect_series<2>(parameters());
  expect_series<3>(parameters());
}

}  // namespace
}  // namespace mpm
