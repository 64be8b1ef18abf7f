// What the affine schemes are there for: rotation survives the way to the grid and back.
#include "expect_equal.hpp"

namespace mpm {
namespace {

template <int Dim>
Matrix<Dim> spin()
{
  Matrix<Dim> w = Matrix<Dim>::Zero();
  w(1, 0) = 3;  // 1/s
  w(0, 1) = -3;
  return w;
}

template <int Dim>
Cloud<Dim> spinning_cloud(TransferCase c, bool musl)
{
  Cloud<Dim> cloud(c, musl);
  for (NaiveParticle<Dim>& p : cloud.particles) {
    p.v = spin<Dim>() * (p.x - cloud.lower_corner());
    if (cloud.naive.affine()) p.affine = spin<Dim>();
    p.stress.setZero();
  }
  cloud.fill_body();
  return cloud;
}

/// Largest change of a particle velocity by one way to the grid and back, without forces.
template <int Dim>
double change_of_velocity(TransferCase c)
{
  Cloud<Dim> cloud = spinning_cloud<Dim>(c, true);
  const Eigen::MatrixXd before = motion_of(cloud, Dim, Dim);
  cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, true);
  cloud.grid.fields.update_velocity(cloud.grid.topology.runs(), 0);
  cloud.transfer->musl_velocity(cloud.body, cloud.grid.topology, cloud.grid.fields);
  return (motion_of(cloud, Dim, Dim) - before).cwiseAbs().maxCoeff();
}

TEST(RigidRotation, SurvivesTheWayToTheGridAndBackWithAnAffineScheme)
{
  // Nodes with little mass divide by it: a rounding of 1e-16 in a momentum over a mass of 1e-4.
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>())
    for (const OneOf<SchemeRow> scheme : {"apic", "tpic"}) {
      EXPECT_LT(change_of_velocity<2>({shape, scheme}), 1e-10);
      EXPECT_LT(change_of_velocity<3>({shape, scheme}), 1e-10);
    }
}

TEST(RigidRotation, IsDampedByPicAndKeptByFlip)
{
  EXPECT_GT(change_of_velocity<2>({"quadratic", "pic"}), 0.05);
  EXPECT_EQ(change_of_velocity<2>({"quadratic", "flip"}), 0);
}

TEST(RigidRotation, IsSeenAsASpinWithoutStrainByTheMuslRemap)
{
  // Only with the affine part in the remap: without it the gradient would hold strains of order 1.
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>())
    for (const OneOf<SchemeRow> scheme : {"apic", "tpic"}) {
      Cloud<2> cloud = spinning_cloud<2>({shape, scheme}, true);
      cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, true);
      cloud.grid.fields.update_velocity(cloud.grid.topology.runs(), 0);
      cloud.transfer->musl_velocity(cloud.body, cloud.grid.topology, cloud.grid.fields);
      cloud.grid.fields.gradient_from_remap(cloud.grid.topology.runs());
      cloud.transfer->musl_stress(cloud.body, cloud.grid.topology, cloud.grid.fields, 0,
                                  cloud.wide_bounds());
      const ColumnGroup& state = cloud.body.particles.state();
      for (int p = 0; p < cloud.count; ++p)
        for (int k = 0; k < 4; ++k)
          EXPECT_NEAR(state(RecordingLaw<2>::gradient + k, p), spin<2>()(k % 2, k / 2), 1e-9)
              << "particle " << p << ", column " << k;
    }
}

TEST(AngularMomentum, OfTheParticlesWithTheirAffineFieldsIsThatOfTheNodes)
{
  // sum x_i x w m (v + C (x_i - x_p)) = x_p x m v + m (C_yx D_xx - C_xy D_yy), D = sum w off^2.
  for (const OneOf<SchemeRow> scheme : all_of_list<SchemeRow>()) {
    Cloud<2> cloud({"quadratic", scheme});
    cloud.transfer->prime(cloud.body, cloud.grid.topology, cloud.grid.fields, false);
    const auto cross = [](const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; };
    double on_nodes = 0, on_particles = 0;
    for (LocalIndex i = 0; i < cloud.grid.topology.size(); ++i)
      on_nodes += cross(cloud.nodes[i].x, momentum_of(cloud.grid, i));
    const Vec<2> moment = cloud.naive.h.cwiseAbs2() / 4;  // of quadratic splines, everywhere
    for (const NaiveParticle<2>& p : cloud.particles)
      on_particles +=
          p.mass * (cross(p.x, p.v) + p.affine(1, 0) * moment[0] - p.affine(0, 1) * moment[1]);
    EXPECT_NEAR(on_nodes, on_particles, 500 * rounding);  // 61 terms of size 5
  }
}

}  // namespace
}  // namespace mpm
