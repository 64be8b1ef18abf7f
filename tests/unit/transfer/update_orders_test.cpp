// The passes of MUSL, USF, USAVG and USL, one after the other, against the naive formulae.
#include "expect_equal.hpp"

namespace mpm {
namespace {

class UpdateOrders : public TransferTest {};
INSTANTIATE_TEST_SUITE_P(All, UpdateOrders,
                         testing::Combine(testing::ValuesIn(all_of_list<ShapeRow>()),
                                          testing::ValuesIn(all_of_list<SchemeRow>())),
                         case_name);

constexpr double dt = 0.02;

template <int Dim>
void forget_sums(typename NaiveTransfer<Dim>::Nodes& nodes)
{
  for (NaiveNode<Dim>& node : nodes) {
    node.mass = 0;
    node.momentum.setZero();
    node.force.setZero();
  }
}

constexpr bool without_force = true;

/// The end of a step: moved, and the sums of the new places.
template <int Dim>
void expect_moved(Cloud<Dim>& cloud, bool no_force = false)
{
  cloud.naive.move(cloud.particles, dt);
  forget_sums<Dim>(cloud.nodes);
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  if (no_force)
    for (NaiveNode<Dim>& node : cloud.nodes) node.force.setZero();
  expect_particles_equal(cloud);
  expect_nodes_equal(cloud);
}

template <int Dim>
void expect_musl(TransferCase c)
{
  Cloud<Dim> cloud(c, true);
  cloud.set_random_velocities();
  cloud.transfer->musl_velocity(cloud.body, cloud.grid.topology, cloud.grid.fields);
  cloud.naive.velocity_to_particles(cloud.nodes, cloud.particles);
  expect_particles_equal(cloud);

  // The remap carries the new velocities, with their affine part, to the old place.
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  for (LocalIndex i = 0; i < cloud.grid.topology.size(); ++i) {
    EXPECT_LT((remap_of(cloud.grid, i) - cloud.nodes[i].momentum).norm(), 100 * rounding);
    EXPECT_EQ(cloud.grid.fields.mass_of(i), 0) << "a remap adds no mass";
    EXPECT_EQ(force_of(cloud.grid, i).norm(), 0) << "a remap adds no force";
  }

  cloud.transfer->musl_stress(cloud.body, cloud.grid.topology, cloud.grid.fields, dt,
                              cloud.wide_bounds());
  cloud.naive.stress_update(cloud.nodes, cloud.particles, dt);
  expect_moved(cloud);
}

TEST_P(UpdateOrders, MuslRemapsTheNewVelocitiesThenUpdatesStressAndMoves)
{
  expect_musl<2>(parameters());
  expect_musl<3>(parameters());
}

template <int Dim>
void expect_one_displacement(TransferCase c)
{
  Cloud<Dim> cloud(c, true);
  cloud.set_random_velocities();
  cloud.transfer->musl_velocity(cloud.body, cloud.grid.topology, cloud.grid.fields);
  cloud.naive.velocity_to_particles(cloud.nodes, cloud.particles);
  cloud.transfer->musl_displacement(cloud.body, cloud.grid.topology, cloud.grid.fields, dt,
                                    cloud.wide_bounds());
  cloud.naive.stress_update(cloud.nodes, cloud.particles, dt);
  cloud.naive.gradient_velocity_to_moves(cloud.nodes, cloud.particles);
  expect_moved(cloud);
}

TEST_P(UpdateOrders, MuslDisplacementMovesByTheVelocityThatTheStressSees)
{
  expect_one_displacement<2>(parameters());
  expect_one_displacement<3>(parameters());
}

template <int Dim>
void expect_usf(TransferCase c)
{
  Cloud<Dim> cloud(c);
  cloud.set_random_velocities();
  cloud.transfer->usf_stress(cloud.body, cloud.grid.topology, cloud.grid.fields, dt);
  cloud.naive.stress_update(cloud.nodes, cloud.particles, dt);
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  for (LocalIndex i = 0; i < cloud.grid.topology.size(); ++i) {
    EXPECT_LT((force_of(cloud.grid, i) - cloud.nodes[i].force).norm(), 200 * rounding);
    EXPECT_EQ(momentum_of(cloud.grid, i).norm(), 0) << "the force pass adds no momentum";
  }
  expect_particles_equal(cloud);

  cloud.grid.fields.reset(cloud.grid.topology.runs());
  cloud.transfer->usf_velocity(cloud.body, cloud.grid.topology, cloud.grid.fields, dt,
                               cloud.wide_bounds());
  cloud.naive.velocity_to_particles(cloud.nodes, cloud.particles);
  cloud.naive.move_with_updated_velocity(cloud.nodes, cloud.particles, dt);
  forget_sums<Dim>(cloud.nodes);
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  for (NaiveNode<Dim>& node : cloud.nodes) node.force.setZero();
  expect_particles_equal(cloud);
  expect_nodes_equal(cloud);
}

TEST_P(UpdateOrders, UsfUpdatesStressAtTheOldPlaceThenVelocityAndPlace)
{
  expect_usf<2>(parameters());
  expect_usf<3>(parameters());
}

/// The half with which the step ends; the other one is USF's.
template <int Dim>
void expect_usavg(TransferCase c)
{
  Cloud<Dim> cloud(c, true);
  cloud.set_random_velocities();
  cloud.transfer->musl_velocity(cloud.body, cloud.grid.topology, cloud.grid.fields);
  cloud.naive.velocity_to_particles(cloud.nodes, cloud.particles);
  cloud.transfer->usavg_stress(cloud.body, cloud.grid.topology, cloud.grid.fields, dt,
                               cloud.wide_bounds());
  cloud.naive.stress_update(cloud.nodes, cloud.particles, 0.5 * dt);
  expect_moved(cloud, without_force);
}

TEST_P(UpdateOrders, UsavgEndsWithHalfOfTheStrainAndAWholeMove)
{
  expect_usavg<2>(parameters());
  expect_usavg<3>(parameters());
}

template <int Dim>
void expect_usl(TransferCase c)
{
  Cloud<Dim> cloud(c);
  cloud.set_random_velocities();
  cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, dt, cloud.wide_bounds());
  cloud.naive.stress_update(cloud.nodes, cloud.particles, dt);
  cloud.naive.velocity_to_particles(cloud.nodes, cloud.particles);
  cloud.naive.move(cloud.particles, dt);
  cloud.naive.to_grid(cloud.particles, cloud.nodes);
  expect_particles_equal(cloud);
  expect_nodes_equal(cloud);
}

TEST_P(UpdateOrders, UslDoesEverythingInOnePass)
{
  expect_usl<2>(parameters());
  expect_usl<3>(parameters());
}

}  // namespace
}  // namespace mpm
