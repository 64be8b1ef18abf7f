#include "expect_equal.hpp"

namespace mpm {
namespace {

class GridToParticle : public TransferTest {};
INSTANTIATE_TEST_SUITE_P(All, GridToParticle,
                         testing::Combine(testing::ValuesIn(all_of_list<ShapeRow>()),
                                          testing::ValuesIn(all_of_list<SchemeRow>())),
                         case_name);

constexpr double dt = 0.01;

template <int Dim>
void expect_linear_fields_exactly(TransferCase c)
{
  Cloud<Dim> cloud(c);
  const Matrix<Dim> slope = cloud.template numbers<Dim, Dim>();
  const Matrix<Dim> increment_slope = cloud.template numbers<Dim, Dim>();
  const Vec<Dim> offset = cloud.template numbers<Dim, 1>();
  cloud.set_velocities([&](NaiveNode<Dim>& n) {
    n.velocity = n.gradient_velocity = slope * n.x + offset;
    n.increment = increment_slope * n.x - offset;
  });
  for (NaiveParticle<Dim>& p : cloud.particles) {
    const Vec<Dim> velocity = slope * p.x + offset;
    p.v = c.scheme->book == ReactionBook::increments
              ? Vec<Dim>(p.v + increment_slope * p.x - offset)
              : velocity;
    p.gradient = slope;
    if (cloud.naive.affine()) p.affine = slope;
    p.x += dt * velocity;
    p.domain += dt * slope * p.domain;
  }
  cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, dt, cloud.wide_bounds());
  expect_particles_equal(cloud);
}

TEST_P(GridToParticle, OfALinearFieldGivesVelocityAndGradientExactly)
{
  expect_linear_fields_exactly<2>(parameters());
  expect_linear_fields_exactly<3>(parameters());
}

template <int Dim>
void compare_with_the_double_loop(TransferCase c)
{
  Cloud<Dim> cloud(c);
  cloud.set_random_velocities();
  cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, dt, cloud.wide_bounds());
  cloud.naive.stress_update(cloud.nodes, cloud.particles, dt);
  cloud.naive.velocity_to_particles(cloud.nodes, cloud.particles);
  cloud.naive.move(cloud.particles, dt);
  expect_particles_equal(cloud);
}

TEST_P(GridToParticle, OfARandomFieldEqualsTheDoubleLoop)
{
  compare_with_the_double_loop<2>(parameters());
  compare_with_the_double_loop<3>(parameters());
}

/// FLIP's velocity and, by a share, the grid's.
void expect_blend(const char* shape, double pic_share, double tolerance)
{
  Cloud<2> cloud({shape, "flip"}, false, false, pic_share);
  cloud.set_velocities([](NaiveNode<2>& n) {
    n.velocity = {100, 200};
    n.increment = {0.25, -0.5};
  });
  cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, 0, cloud.wide_bounds());
  for (int p = 0; p < cloud.count; ++p) {
    const Vec<2> v(cloud.body.particles.motion()(2, p), cloud.body.particles.motion()(3, p));
    const Vec<2> flip = cloud.particles[p].v + Vec<2>(0.25, -0.5);
    EXPECT_LT((v - (1 - pic_share) * flip - pic_share * Vec<2>(100, 200)).norm(), tolerance);
  }
}

TEST(FlipScheme, AddsTheIncrementAndForgetsTheGridVelocity)
{
  expect_blend("quadratic", 0, rounding);
}

TEST(FlipScheme, BlendsWithTheGridVelocity)
{
  for (const char* shape : {"quadratic", "cpdi"}) expect_blend(shape, 0.25, 10 * rounding);
}

TEST(PicScheme, TakesTheGridVelocityAndForgetsItsOwn)
{
  Cloud<2> cloud({"gimp", "pic"});
  cloud.set_velocities([](NaiveNode<2>& n) {
    n.velocity = {3, 4};
    n.increment = {50, 60};
  });
  cloud.transfer->usl(cloud.body, cloud.grid.topology, cloud.grid.fields, 0, cloud.wide_bounds());
  for (int p = 0; p < cloud.count; ++p) {
    EXPECT_NEAR(cloud.body.particles.motion()(2, p), 3, 10 * rounding);
    EXPECT_NEAR(cloud.body.particles.motion()(3, p), 4, 10 * rounding);
  }
}

template <int Dim>
void expect_apic_to_be_tpic()
{
  Cloud<Dim> apic({"linear", "apic"});
  Cloud<Dim> tpic({"linear", "tpic"});
  apic.set_random_velocities();
  tpic.set_random_velocities();  // the same ones
  apic.transfer->usl(apic.body, apic.grid.topology, apic.grid.fields, dt, apic.wide_bounds());
  tpic.transfer->usl(tpic.body, tpic.grid.topology, tpic.grid.fields, dt, tpic.wide_bounds());
  const int width = apic.body.particles.motion().width();
  EXPECT_LT((motion_of(apic, 0, width) - motion_of(tpic, 0, width)).norm(), 100 * rounding);
}

TEST(ApicScheme, IsTpicForLinearFunctions)
{
  expect_apic_to_be_tpic<2>();
  expect_apic_to_be_tpic<3>();
}

TEST(ApicScheme, IsNotTpicForQuadraticFunctions)
{
  Cloud<2> apic({"quadratic", "apic"});
  Cloud<2> tpic({"quadratic", "tpic"});
  apic.set_random_velocities();
  tpic.set_random_velocities();
  apic.transfer->usl(apic.body, apic.grid.topology, apic.grid.fields, dt, apic.wide_bounds());
  tpic.transfer->usl(tpic.body, tpic.grid.topology, tpic.grid.fields, dt, tpic.wide_bounds());
  EXPECT_GT((motion_of(apic, 5, 4) - motion_of(tpic, 5, 4)).norm(), 0.1);
}

}  // namespace
}  // namespace mpm
