/// One-sided walls, and contact between bodies in velocity fields of their own.

#include <mpm/conditions/body_contact.hpp>

#include <algorithm>
#include <cmath>

#include "flying_block.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace testing_blocks;

constexpr double share = 0.3;
const Method pushed{"gimp", "flip", "musl_displacement"};

/// Momentum and energy of all ranks.
struct Totals {
  Vec<2> momentum = Vec<2>::Zero();
  double kinetic = 0, elastic = 0;
};
Totals totals_of(UpdatedLagrangian<2>& stepper)
{
  const Carried<2> carried = stepper.carried();
  double elastic = 0;
  for (const Body<2>& body : stepper.bodies())
    for (LocalIndex b = 0; b < body.particles.blocks(); ++b)
      elastic += stdx::reduce(body.law->elastic_energy(body.particles.state().block(b)));
  std::array<double, 4> sums{carried.momentum[0], carried.momentum[1], carried.kinetic_energy,
                             elastic + (carried.contact ? carried.contact->energy : 0)};
  sum_over_ranks(MPI_COMM_WORLD, sums);
  return {{sums[0], sums[1]}, sums[2], sums[3]};
}

void expect_same(const Gathered& together, const Gathered& alone, double tolerance)
{
  EXPECT_THAT(together.holders, testing::Each(1));
  for (std::size_t k = 0; k < alone.position.size(); ++k)
    ASSERT_NEAR(together.position[k], alone.position[k], tolerance * cell) << k;
}

constexpr double wall_at = 20.3 * cell, speed = 10;  // m, m/s
/// A block that flies along x to a wall at rest, which it reaches after 3.3 cells.
BlockRun to_the_wall(MPI_Comm comm)
{
  BlockRun::Conditions walls;
  walls.push_back(std::make_unique<RigidWall<2>>(
      WallPlacement{0, true, wall_at}, WallMotion{}, WallGrip::contact, ReactionBook::increments,
      WallStiffness<2>{0.5, Vec<2>::Constant(0.5 * cell)}));
  return {Decomposition<2>(comm, BlockRun::grid_of({26, 18}), {0, 0}, {}, {}),
          pushed,
          {{{7, 4}, {10, 8}, {speed, 0}}},
          std::move(walls)};
}

TEST(PushingWall, ThrowsABlockBackWithAllItsEnergyAndBooksTheImpulse)
{
  BlockRun run = to_the_wall(MPI_COMM_WORLD);
  const Totals before = totals_of(run.stepper());
  const Gathered start = run.gather();
  double farthest = 0;
  bool touched = false;
  for (int k = 0; k < 60; ++k) {
    run.advance(40, share, speed);
    const Gathered now = run.gather();
    const auto n = now.mass.size();
    const double front =
        *std::max_element(now.position.begin(), now.position.begin() + std::ptrdiff_t(n)) +
        0.25 * cell;
    const double free = speed * run.stepper().time() + 17 * cell;
    // It flies on undisturbed until it is there.
    if (free < wall_at) {
      EXPECT_NEAR(front, free, 1e-9 * cell);
    }
    touched = touched || front > wall_at;
    farthest = std::max(farthest, front);
  }
  ASSERT_TRUE(touched);
  EXPECT_LT(farthest, wall_at + 0.1 * cell);  // 10 MPa over kappa C
  const Totals after = totals_of(run.stepper());
  EXPECT_LT(after.momentum[0], -0.8 * before.momentum[0]);  // the rest rings
  // Kinetic and elastic energy stand half a step apart while it rings.
  EXPECT_NEAR(after.kinetic + after.elastic, before.kinetic, 2e-3 * before.kinetic);
  Reaction<2> reaction = run.stepper().slots().conditions[0]->take_reaction();
  sum_over_ranks(MPI_COMM_WORLD, std::span(reaction.impulse.data(), 2));
  EXPECT_NEAR(after.momentum[0] - before.momentum[0], reaction.impulse[0],
              1e-9 * before.momentum[0]);  // what nodes below the mass cut of 1e-12 lose
  EXPECT_EQ(reaction.work, 0);
}

TEST(PushingWall, ThrowsTheBlockTheSameWayOnAnyNumberOfRanks)
{
  BlockRun together = to_the_wall(MPI_COMM_WORLD), alone = to_the_wall(MPI_COMM_SELF);
  together.advance(1200, share, speed);
  alone.advance(1200, share, speed);
  const Gathered shared = together.gather();
  if (rank_of(MPI_COMM_WORLD) == 0) expect_same(shared, alone.gather(), 1e-8);
}

/// Two blocks that fly into each other, askew or head on.
struct Collision {
  BodyContact<2>* contact = nullptr;
  std::optional<BlockRun> run;

  Collision(MPI_Comm comm, double friction, const Method& method = {"gimp", "flip", "musl"},
            bool askew = true)
  {
    auto transfer = make_transfer<2>(method.shape, method.scheme, {0.5});
    const auto weight = [&](double x) { return transfer->weight_along(x, 0.5); };
    BlockRun::Contacts contacts;
    contacts.push_back(std::make_unique<BodyContact<2>>(
        2, std::vector<BodyContact<2>::Pair>{{0, 1, friction}}, SurfacePlace(weight, 0.5),
        ReactionBook{method.scheme->book}));
    contact = static_cast<BodyContact<2>*>(contacts.front().get());
    run.emplace(Decomposition<2>(comm, BlockRun::grid_of({30, 22}), {0, 0}, {}, {}), method,
                std::vector<Block>{
                    {{5, 6}, {8, 9}, {speed, askew ? 0.2 * speed : 0}},
                    {{16, askew ? 7 : 6}, {7, 9}, {-speed, askew ? -0.1 * speed : 0}, {}, 1}},
                BlockRun::Conditions{}, std::move(contacts));
  }
};

TEST(BodyContact, KeepsMomentumToRoundingAndGainsNoEnergy)
{
  for (const double friction : {0.0, 0.3, 1e9}) {
    Collision collision(MPI_COMM_WORLD, friction);
    UpdatedLagrangian<2>& stepper = collision.run->stepper();
    const Totals before = totals_of(stepper);
    collision.run->advance(1600, share, speed);
    const Totals after = totals_of(stepper);
    const double pushed_through = 2 * before.kinetic / speed;
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-10 * pushed_through) << friction;
    Reaction<2> reaction = collision.contact->take_reaction();
    sum_over_ranks(MPI_COMM_WORLD, std::span(&reaction.work, 1));
    const double gained = after.kinetic + after.elastic - before.kinetic - reaction.work;
    EXPECT_LT(gained, 0.002 * before.kinetic) << friction;
    // Flat faces that meet at once: what the grid cannot carry of the impact.
    EXPECT_GT(gained, -0.06 * before.kinetic) << friction;
    double friction_work = collision.contact->sums()->friction_work;
    sum_over_ranks(MPI_COMM_WORLD, std::span(&friction_work, 1));
    if (friction == 0) {
      EXPECT_NEAR(friction_work, 0, 1e-12 * before.kinetic);
    } else if (friction < 1) {
      EXPECT_GT(friction_work, 1e-3 * before.kinetic);
    }
    EXPECT_LT(reaction.work, 1e-3 * before.kinetic);
  }
}

TEST(BodyContact, IsNotFeltBeforeTheBodiesMeet)
{
  constexpr bool askew = false;
  Collision collision(MPI_COMM_WORLD, 0.3, {"gimp", "flip", "musl"}, askew);
  BlockRun& run = *collision.run;
  const Gathered start = run.gather();
  const auto n = start.mass.size();
  // The gap of three cells closes with twice the speed; nodes are shared from a gap of 2.5 cells
  // on.
  const double meeting = 1.5 * cell / speed;
  while (run.stepper().time() < 0.97 * meeting) run.advance(1, share, speed);
  const Gathered now = run.gather();
  for (std::size_t p = 0; p < n; ++p)
    EXPECT_NEAR(now.velocity[p], start.velocity[p], 1e-9 * speed) << p;
  run.advance(100, share, speed);
  const Gathered later = run.gather();
  double changed = 0;
  for (std::size_t p = 0; p < n; ++p)
    changed = std::max(changed, std::abs(later.velocity[p] - start.velocity[p]));
  EXPECT_GT(changed, 0.5 * speed);
}

TEST(BodyContact, LetsBodiesPartAndKeepsThemApart)
{
  Collision collision(MPI_COMM_WORLD, 0);
  BlockRun& run = *collision.run;
  double deepest = 0;
  std::size_t first = 4 * 8 * 9;  // particles of the first block
  for (int k = 0; k < 50; ++k) {
    run.advance(40, share, speed);
    const Gathered now = run.gather();
    const auto middle = now.position.begin() + std::ptrdiff_t(first);
    const double front = *std::max_element(now.position.begin(), middle);
    const double back =
        *std::min_element(middle, now.position.begin() + std::ptrdiff_t(now.mass.size()));
    deepest = std::max(deepest, front + 0.5 * cell - back);
  }
  EXPECT_LT(deepest, 0.15 * cell);
  const Gathered now = run.gather();
  double first_velocity = 0;
  for (std::size_t p = 0; p < first; ++p) first_velocity += now.velocity[p] / double(first);
  EXPECT_LT(first_velocity, 0);  // thrown back
}

TEST(BodyContact, MovesBodiesTheSameWayOnAnyNumberOfRanks)
{
  for (const Method& method :
       {Method{"gimp", "flip", "musl"}, Method{"quadratic", "apic", "musl"}}) {
    Collision together(MPI_COMM_WORLD, 0.3, method), alone(MPI_COMM_SELF, 0.3, method);
    together.run->advance(900, share, speed);
    alone.run->advance(900, share, speed);
    const Gathered shared = together.run->gather();
    if (rank_of(MPI_COMM_WORLD) == 0) expect_same(shared, alone.run->gather(), 1e-6);
  }
}

}  // namespace
}  // namespace mpm
