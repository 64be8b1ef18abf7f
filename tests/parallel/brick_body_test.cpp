// Bodies of bricks that fly, turn, are crushed and meet, on any ranks.
#include <mpm/core/memory_archive.hpp>

#include "brick_bodies.hpp"
#include "ragged_blocks.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

TEST(BrickBody, FliesWithoutEffect)
{
  const Vec<3> velocity(30, -20, 10);
  Bricks run(MPI_COMM_WORLD, {.velocity = velocity});
  const Bricks::Found before = run.found();
  run.advance(200);
  const Bricks::Found after = run.found();
  EXPECT_NEAR(after.energy / before.energy, 1, 1e-12);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
  for (std::size_t k = 0; k < before.places.size(); ++k)
    ASSERT_NEAR(after.places[k] - before.places[k],
                run.stepper().time() * velocity[Eigen::Index(k % 3)], 1e-14);
}

TEST(BrickBody, TurnsAndSwingsAndKeepsEnergyAndMomentum)
{
  Bricks run(MPI_COMM_WORLD, {.velocity = {5, 0, 2}, .turning = {3000, -4000, 8000}});
  const Bricks::Found before = run.found();
  run.advance(2500);  // more than half a turn
  const Bricks::Found after = run.found();
  EXPECT_NEAR(after.energy / before.energy, 1, 2e-3);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-11 * before.momentum.norm());
}

/// Walls meet the nodes one-sidedly; what they do is what is stored, dissipated and moving.
TEST(BrickBody, IsCrushedWithAClosedBalanceOnAnyRanks)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true};
  Bricks together(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  together.advance(500);
  alone.advance(500);
  EXPECT_LT(largest_difference(together.found().places, alone.found().places), 1e-10 * cell);
  double work = 0;
  Vec<3> impulse = Vec<3>::Zero();
  Bricks::Found now = together.found();
  const Bricks::Found first = now;
  for (int k = 0; k < 5; ++k) {
    together.advance(100);
    now = together.found();
    work += now.work;
    impulse += now.impulse;
  }
  EXPECT_GT(now.bending, 0.01 * work);
  EXPECT_NEAR((now.energy - first.energy) / work, 1, 2e-3);
  EXPECT_LT((now.momentum - first.momentum - impulse).norm(),
            1e-11 * std::sqrt(2 * now.energy * together.mass()));
}

TEST(BrickBody, TakesUpWhatWasSavedToTheLastBit)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true};
  Bricks run(MPI_COMM_WORLD, scene), other(MPI_COMM_WORLD, scene);
  run.advance(310);
  MemoryArchive archive;
  archive.start_saving();
  run.stepper().archive(archive);
  archive.start_loading();
  other.stepper().archive(archive);
  EXPECT_TRUE(archive.unread().empty());
  run.advance(130);
  other.advance(130);
  const Bricks::Found one = run.found(), two = other.found();
  EXPECT_EQ(one.places, two.places);
  EXPECT_EQ(one.energy, two.energy);
}

TEST(BrickBody, GoesOnAlikeWhereBordersMove)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true, .periodic = true};
  Bricks moved(MPI_COMM_WORLD, scene), still(MPI_COMM_WORLD, scene);
  const Ownership<3> first = moved.stepper().decomposition().ownership();
  still.advance(600);
  moved.advance(300);
  moved.stepper().repartition(scattered_blocks(first.geometry(), 2, first.ranks(), 1));
  moved.advance(200);
  moved.stepper().repartition(first);
  moved.advance(100);
  const Bricks::Found one = still.found(), now = moved.found();
  EXPECT_EQ(now.pairs, one.pairs);
  EXPECT_NEAR(now.energy / one.energy, 1, 1e-10);
  EXPECT_LT(largest_difference(now.places, one.places), 1e-10 * cell);
}

TEST(BrickBody, GoesOnAcrossAPeriodicSide)
{
  const Scene inside{.first_z = 3, .turning = {300, 200, 500}, .periodic = true};
  Scene across = inside;
  across.first_z = 9;  // its upper half comes in from below
  Bricks one(MPI_COMM_WORLD, inside), two(MPI_COMM_WORLD, across);
  one.advance(200);
  two.advance(200);
  const Bricks::Found a = one.found(), b = two.found();
  EXPECT_NEAR(b.energy / a.energy, 1, 1e-12);
  const double period = grid_cells[2] * cell, shift = 6 * size[2];
  for (std::size_t k = 0; k < a.places.size(); ++k) {
    double apart = b.places[k] - a.places[k] - (k % 3 == 2 ? shift : 0.0);
    if (k % 3 == 2) apart -= period * std::round(apart / period);
    ASSERT_NEAR(apart, 0, 1e-10 * cell) << k;
  }
}

/// Two blocks with a gap of two locations, which do not quite lie above each other.
bool is_in_blocks(const IndexVec<3>& at)
{
  if (at[2] < 2) return at[0] < 6 && at[1] < 6;
  return at[2] >= 4 && at[0] >= 1 && at[0] < 7 && at[1] >= 1 && at[1] < 7;
}

/// They meet, skewly, press and part again: on one rank as on many, and across a periodic side.
TEST(BrickBody, MeetsAnotherAndKeepsEnergyAndMomentum)
{
  const Scene scene{.is_taken = is_in_blocks, .turning = {150, -200, 250}, .apart = -10};
  Bricks together(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  Scene through_side = scene;
  through_side.periodic = true;
  through_side.first_z = 9;
  Bricks across(MPI_COMM_WORLD, through_side);
  const Bricks::Found before = together.found();
  GlobalIndex most_pairs = 0;
  double deepest = 0;
  for (int k = 0; k < 60; ++k) {
    together.advance(40);
    most_pairs = std::max(most_pairs, together.found().pairs);
    deepest = std::max(deepest, together.found().overlapped);
  }
  alone.advance(60 * 40);
  across.advance(60 * 40);
  const Bricks::Found after = together.found(), there = across.found();
  EXPECT_GT(most_pairs, 40);
  EXPECT_GT(deepest, 0);
  EXPECT_EQ(after.overlapped, 0);
  together.advance(1);
  // Velocities stand half a step before what is stored. A sixth of it swings, with frequencies w of
  // up to 0.4 / dt: the mean of what is stored at two steps is too much by (w dt / 2)^2 of that.
  const Bricks::Found next = together.found();
  EXPECT_NEAR((next.energy - 0.5 * (next.stored - after.stored)) / before.energy, 1, 8e-3);
  EXPECT_LT((after.momentum - before.momentum).norm(),
            1e-11 * std::sqrt(2 * after.energy * together.mass()));
  EXPECT_LT(largest_difference(after.places, alone.found().places), 1e-10 * cell);
  const double period = grid_cells[2] * cell;
  for (std::size_t k = 0; k < after.places.size(); ++k) {
    double apart = there.places[k] - after.places[k] - (k % 3 == 2 ? 6 * size[2] : 0.0);
    if (k % 3 == 2) apart -= period * std::round(apart / period);
    ASSERT_NEAR(apart, 0, 1e-10 * cell) << k;
  }
  // The lower block, first in the order of cells, is still the lower one, and moves down.
  const auto height = [](const Bricks::Found& found, std::size_t first) {
    double sum = 0;
    for (std::size_t k = 0; k < 36; ++k) sum += found.places[3 * (first + k) + 2] / 36;
    return sum;
  };
  EXPECT_LT(height(after, 0), height(before, 0) + 0.5 * size[2]);
  EXPECT_GT(height(after, 72), height(after, 0) + 3 * size[2]);
}

/// A plate of one location between two blocks that walls press together. It bears on both sides
/// what the walls do, and is not gone through.
TEST(BrickBody, PressesAPlateOfOneBrickFromBothSides)
{
  const auto is_taken = [](const IndexVec<3>& at) {
    return at[0] == 5 || (at[1] >= 2 && at[1] < 8 && (at[0] < 4 || at[0] >= 7));
  };
  Bricks run(MPI_COMM_WORLD, {.is_taken = is_taken, .pressed = true});
  const Bricks::Found first = run.found();
  // From a gap of a location on either side on, by a third of one: 3 % of what is between them.
  const double step = 0.2 * size[0] / run.stepper().bodies()[0].law->wave_speed();
  run.advance(int(1.35 * size[0] / (wall_speed * step)));
  const Bricks::Found now = run.found();
  run.advance(1);
  // Velocities and work stand half a step before what is stored.
  const Bricks::Found next = run.found();
  const double energy = next.energy - 0.5 * (next.stored - now.stored);
  EXPECT_NEAR((energy - first.energy) / (now.work + next.work), 1, 3e-3);
  EXPECT_GT(now.pairs, 2 * 36);
  // Flush on 6 x 6 locations on either side: so deep on the mean, in locations.
  const double depth = now.overlapped / (2 * 36 * size.prod());
  EXPECT_GT(depth, 1e-3);
  EXPECT_LT(depth, 0.05);
  // The plate's bricks lie on both blocks, two locations apart and so one wall to them, with a part
  // of what they are by now.
  EXPECT_NEAR(now.deepest / (2 * depth), 1, 0.15);
}

}  // namespace
}  // namespace mpm
