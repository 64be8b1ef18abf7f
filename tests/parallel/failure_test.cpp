// Cells that fail: what is left flies on, meets and closes its balance, on any ranks.
#include <mpm/core/memory_archive.hpp>

#include "failing_bars.hpp"
#include "other_borders.hpp"
#include "ragged_blocks.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

/// Torn in two by its own motion, in steps so short that what swings then, with w up to 2 c / h,
/// changes the mean of what is stored by (w dt / 2)^2 at most.
const Scene<2> torn{
    .cells = {20, 8}, .limits = {.stretch = 1.04}, .rate = 3e4, .fly = 30, .step = 0.005};

/// Crushed in the middle until that fails.
const Scene<2> pressed{.cells = {20, 9},
                       .weak = 3,
                       .limits = {.plastic_strain = 0.05},
                       .yield = 5e6,
                       .wall_speed = 10};

/// m, between the middles of the cells on both sides of the weak ones, in a row across.
template <int Dim>
double gap(const Bar<Dim>& bar, const SumsOfBodies<Dim>& found, const Scene<Dim>& scene, int row)
{
  IndexVec<Dim> left = IndexVec<Dim>::Zero();
  left[0] = (scene.cells[0] - scene.weak) / 2 - 1;
  left[1] = row;
  IndexVec<Dim> right = left;
  right[0] += scene.weak + 1;
  return bar.place(found, right, 0) - bar.place(found, left, 0);
}

/// Stretches a bar of any kind until it is torn, and longer. Returns what it was.
template <int Dim>
void expect_torn(const Scene<Dim>& scene, int steps, double energy_bound)
{
  Bar<Dim> bar(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  const auto before = bar.balanced();
  bar.advance(steps);
  alone.advance(steps + 1);
  const auto torn = bar.found();
  EXPECT_EQ(torn.failed, bar.weak_cells());
  EXPECT_EQ(torn.failed, alone.found().failed);
  EXPECT_LT(largest_difference(torn.places, alone.found().places), 1e-9 * edge);
  bar.advance(steps);
  const auto after = bar.balanced();
  EXPECT_NEAR(after.energy / before.energy, 1, energy_bound);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
  for (int row = 0; row < scene.cells[1]; ++row)
    EXPECT_GT(gap(bar, after, scene, row), gap(bar, torn, scene, row) + 0.5 * edge);
}

TEST(Failure, TearsABarInTwoAndKeepsEnergyAndMomentum)
{
  expect_torn<2>(torn, 1500, 1e-6);
}

TEST(Failure, TearsAPlateInSpaceThatIsTwisted)
{
  expect_torn<3>({.cells = {16, 6, 1},
                  .limits = {.stretch = 1.04},
                  .rate = 3e4,
                  .fly = 30,
                  .twist = 3000,
                  .step = 0.005},
                 1500, 1e-6);
}

/// What flows gains (w dt)^2 in every step, with or without a failure in it: what fails takes along
/// what it had.
TEST(Failure, OfPlasticStrainChangesTheBalanceNoMoreThanTheFlowBefore)
{
  Scene<2> scene = torn;
  scene.limits = {.plastic_strain = 0.3};
  scene.yield = 5e6;
  scene.step = 0.02;
  Bar<2> bar(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  bar.advance(3);
  const auto start = bar.balanced();
  auto last = bar.balanced();
  double flowing = 0, failing = 0, energy = last.energy;
  while (bar.stepper().steps() < 800) {
    const GlobalIndex failed_before = last.failed;
    last = bar.balanced();
    double& largest = last.failed > failed_before ? failing : flowing;
    largest = std::max(largest, std::abs(last.energy - energy) / start.energy);
    energy = last.energy;
  }
  EXPECT_EQ(last.failed, bar.weak_cells());
  EXPECT_GT(failing, 0);
  EXPECT_LT(failing, 1.2 * flowing);
  EXPECT_LT(flowing, 3e-6);
  while (alone.stepper().steps() < bar.stepper().steps()) alone.advance(1);
  EXPECT_EQ(alone.found().failed, last.failed);
  EXPECT_LT(largest_difference(last.places, alone.found().places), 1e-9 * edge);
}

/// Walls press on a bar whose middle is crushed until it fails; across the gap that it leaves the
/// halves come to meet, in the middle of the bar too, where no surface was.
TEST(Failure, LeavesSurfacesThatMeet)
{
  Bar<2> bar(MPI_COMM_WORLD, pressed), alone(MPI_COMM_SELF, pressed);
  const auto first = bar.found();
  double work = 0;
  Vec<2> impulse = Vec<2>::Zero();
  auto now = first;
  for (int k = 0; k < 24; ++k) {
    bar.advance(100);
    now = bar.found();
    work += now.work;
    impulse += now.impulse;
  }
  now = bar.balanced();
  work += now.work;
  impulse += now.impulse;
  alone.advance(2401);
  EXPECT_EQ(now.failed, bar.weak_cells());
  EXPECT_LT(largest_difference(now.places, alone.found().places), 1e-9 * edge);
  EXPECT_NEAR((now.energy - first.energy) / work, 1, 1e-3);
  EXPECT_LT((now.momentum - first.momentum - impulse).norm(),
            1e-11 * std::sqrt(2 * now.energy * bar.mass()));
  EXPECT_GT(now.pairs, 0);
  for (int row = 0; row < pressed.cells[1]; ++row)
    EXPECT_GT(gap(bar, now, pressed, row), 0.87 * edge);
}

/// Nodes without cells fly on as they did, and no speed of theirs sets a step.
TEST(Failure, OfAllCellsLeavesMassesThatFlyFreely)
{
  Bar<2> bar(MPI_COMM_WORLD,
             {.cells = {12, 6}, .weak = 12, .limits = {.stretch = 1.005}, .rate = 1e5, .fly = 30});
  const auto before = bar.found();
  bar.advance(3);
  const auto torn = bar.found();
  EXPECT_EQ(torn.failed, bar.weak_cells());
  bar.advance(60);
  const auto after = bar.found();
  EXPECT_EQ(bar.stepper().agreed().largest_speed, 0);
  EXPECT_EQ(bar.stepper().agreed().wave_speed, bar.stepper().bodies().back().law->wave_speed());
  EXPECT_EQ(after.stored, torn.stored);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
  bar.advance(60);
  EXPECT_NEAR(bar.found().energy / after.energy, 1, 1e-12);
}

/// Into a run that has not begun, and into one that has lost what the kept state still has.
TEST(Failure, TakesUpWhatWasSavedToTheLastBit)
{
  for (const int steps : {400, 900}) {
    Bar<2> run(MPI_COMM_WORLD, torn), other(MPI_COMM_WORLD, torn),
        torn_already(MPI_COMM_WORLD, torn);
    run.advance(steps);
    torn_already.advance(1200);
    MemoryArchive archive;
    archive.start_saving();
    run.stepper().archive(archive);
    for (Bar<2>* loaded : {&other, &torn_already}) {
      archive.start_loading();
      loaded->stepper().archive(archive);
      EXPECT_TRUE(archive.unread().empty());
    }
    EXPECT_EQ(run.found().failed, steps < 500 ? 0 : run.weak_cells());
    run.advance(800);
    const auto one = run.found();
    for (Bar<2>* loaded : {&other, &torn_already}) {
      loaded->advance(800);
      const auto two = loaded->found();
      EXPECT_EQ(one.failed, two.failed);
      EXPECT_EQ(one.places, two.places);
      EXPECT_EQ(one.energy, two.energy);
    }
  }
}

/// Before cells fail, where some have, and where surfaces that were none have met.
TEST(Failure, GoesOnAlikeWhereBordersMove)
{
  for (const auto& [scene, steps] : {std::pair(torn, 200), std::pair(pressed, 400)}) {
    Bar<2> moved(MPI_COMM_WORLD, scene), still(MPI_COMM_WORLD, scene);
    const Ownership<2> first = moved.stepper().decomposition().ownership();
    GlobalIndex left = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
      left +=
          moved.stepper().repartition(scattered_blocks(first.geometry(), 3, first.ranks(), seed));
      for (Bar<2>* bar : {&moved, &still}) bar->advance(steps);
      const auto one = still.found(), now = moved.found();
      EXPECT_EQ(now.failed, one.failed);
      EXPECT_EQ(now.pairs, one.pairs);
      EXPECT_NEAR(now.energy / one.energy, 1, 1e-9);
      EXPECT_LT((now.momentum - one.momentum).norm(),
                1e-11 * std::sqrt(2 * one.energy * still.mass()));
      EXPECT_LT(largest_difference(now.places, one.places), 1e-9 * edge);
    }
    sum_over_ranks(MPI_COMM_WORLD, std::span(&left, 1));
    EXPECT_EQ(left > 0, first.ranks() > 1);
    EXPECT_EQ(still.found().failed, still.weak_cells());
  }
}

/// Also to cells that have failed since.
TEST(Failure, TakesUpWhatWasSavedWithinOtherBorders)
{
  Bar<2> run(MPI_COMM_WORLD, torn), anew(MPI_COMM_WORLD, torn);
  expect_taken_up_within_other_borders(run, anew, {.before = 300, .compared = 400, .astray = 100});
  EXPECT_EQ(run.found().failed, run.weak_cells());
}

}  // namespace
}  // namespace mpm
