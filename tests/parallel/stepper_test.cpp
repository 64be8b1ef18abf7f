#include <mpm/core/error.hpp>

#include <algorithm>
#include <cmath>

#include "flying_block.hpp"
#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace testing_blocks;
using ::testing::HasSubstr;

const OneOf<ShapeRow> linear = "linear", gimp = "gimp", quadratic = "quadratic", cubic = "cubic",
                      cpdi = "cpdi";
const OneOf<SchemeRow> flip = "flip", pic = "pic", apic = "apic", tpic = "tpic", fmpm = "fmpm",
                       xpic = "xpic";

/// Three in a row and two rows for six ranks, so that corners are crossed.
IndexVec<2> two_rows()
{
  const int ranks = ranks_of(MPI_COMM_WORLD);
  return ranks % 2 == 0 ? IndexVec<2>(ranks / 2, 2) : IndexVec<2>(ranks, 1);
}

/// What all ranks have done together, on rank 0 beside the same run on it alone. Collective.
void expect_same_on_one_rank(const BlockRun& together, BlockRun alone, int steps, double share,
                             double speed, double tolerance)
{
  const Gathered shared = together.gather();
  EXPECT_THAT(shared.holders, ::testing::Each(1));
  if (rank_of(MPI_COMM_WORLD) != 0) return;
  alone.advance(steps, share, speed);
  const Gathered single = alone.gather();
  EXPECT_EQ(shared.mass, single.mass);
  ASSERT_EQ(shared.position.size(), single.position.size());
  double position = 0, velocity = 0, fastest = 0;
  for (std::size_t k = 0; k < single.position.size(); ++k) {
    position = std::max(position, std::abs(shared.position[k] - single.position[k]));
    velocity = std::max(velocity, std::abs(shared.velocity[k] - single.velocity[k]));
    fastest = std::max(fastest, std::abs(single.velocity[k]));
  }
  const double farthest = std::ranges::max(single.position);
  EXPECT_LT(position, tolerance * farthest);
  EXPECT_LT(velocity, 1e3 * tolerance * fastest);  // differences of positions over a step
}

class FlyingBlock : public ::testing::TestWithParam<Method> {
 protected:
  static constexpr double speed = 60;  // m/s
  static constexpr int steps = 700;
  static constexpr double share = 0.4;
  static GridGeometry<2> grid() { return BlockRun::grid_of({34, 27}); }
  static BlockRun make(const Decomposition<2>& decomposition)
  {
    return {decomposition, GetParam(), {{{3, 3}, {8, 6}, {speed, 0.75 * speed}}}, {}};
  }
  static BlockRun alone() { return make({MPI_COMM_SELF, grid(), {0, 0}, {}, {}}); }
};

TEST_P(FlyingBlock, KeepsMassMomentumAndShapeAcrossTheRanks)
{
  BlockRun run = make({MPI_COMM_WORLD, grid(), two_rows(), {}, {}});
  const Gathered before = run.gather();
  run.advance(steps, share, speed);
  const Gathered after = run.gather();
  const double flown = speed * run.stepper().time();
  ASSERT_GT(flown, 10 * cell) << "the block must cross the boundaries of ranks";
  GlobalIndex migrated = run.stepper().counters().migrated;
  sum_over_ranks(MPI_COMM_WORLD, std::span(&migrated, 1));
  if (ranks_of(MPI_COMM_WORLD) > 1) {
    EXPECT_GT(migrated, 0);
  }

  EXPECT_THAT(after.holders, ::testing::Each(1));
  EXPECT_EQ(after.mass, before.mass);
  std::array<double, 2> momentum{}, start{};
  for (std::size_t p = 0; p < after.mass.size(); ++p)
    for (std::size_t d = 0; d < 2; ++d) {
      momentum[d] += after.mass[p] * after.velocity[d * after.mass.size() + p];
      start[d] += before.mass[p] * before.velocity[d * before.mass.size() + p];
      // Rounding of some hundred additions to the position.
      const double moved =
          after.position[d * after.mass.size() + p] - before.position[d * after.mass.size() + p];
      EXPECT_NEAR(moved, (d == 0 ? 1.0 : 0.75) * flown, 1e-10 * flown) << "particle " << p;
    }
  for (std::size_t d = 0; d < 2; ++d) EXPECT_NEAR(momentum[d], start[d], 1e-12 * start[d]);
  // Rounding of uniform grid velocities, v / h, makes the only strain.
  EXPECT_LT(std::ranges::max(after.largest_stress), 1e-9 * youngs_modulus);
}

TEST_P(FlyingBlock, IsAtTheSamePlaceOnAnyNumberOfRanks)
{
  BlockRun run = make({MPI_COMM_WORLD, grid(), two_rows(), {}, {}});
  run.advance(steps, share, speed);
  expect_same_on_one_rank(run, alone(), steps, share, speed, 1e-12);
}

TEST_P(FlyingBlock, IsAtTheSamePlaceOnPartsOfAnyShape)
{
  const int ranks = ranks_of(MPI_COMM_WORLD);
  for (const Ownership<2>& map :
       {scattered_blocks(grid(), 4, ranks, 3), metis_blocks(grid(), ranks)}) {
    BlockRun run = make({MPI_COMM_WORLD, map});
    run.advance(steps, share, speed);
    expect_same_on_one_rank(run, alone(), steps, share, speed, 1e-12);
  }
}

// Linear functions with an affine field are absent: at a free edge nodes of vanishing mass keep
// their velocity in the affine field, and no time step is stable.
INSTANTIATE_TEST_SUITE_P(Methods, FlyingBlock,
                         ::testing::Values(Method{linear, flip, "musl"}, Method{gimp, flip, "musl"},
                                           Method{quadratic, flip, "musl"},
                                           Method{linear, pic, "musl"}, Method{gimp, tpic, "musl"},
                                           Method{quadratic, tpic, "musl"},
                                           Method{quadratic, apic, "usf"}, Method{gimp, pic, "usf"},
                                           Method{gimp, flip, "usl"}, Method{cubic, fmpm, "musl"},
                                           Method{quadratic, flip, "usavg"},
                                           Method{quadratic, flip, "musl_displacement"},
                                           Method{linear, fmpm, "usf"}, Method{cpdi, apic, "musl"},
                                           Method{cpdi, flip, "usf"}),
                         [](const auto& info) { return name_of(info.param); });

/// A piston from the right, three walls, and a second block that flies into the first.
class PressedBlocks : public ::testing::TestWithParam<Method> {
 protected:
  static constexpr double speed = 20;  // m/s
  static constexpr int steps = 500;
  static constexpr double share = 0.4;
  static GridGeometry<2> grid() { return BlockRun::grid_of({26, 20}); }
  static BlockRun make(const Decomposition<2>& decomposition)
  {
    const ReactionBook book = GetParam().scheme->book;
    BlockRun::Conditions walls;
    const auto add = [&](int axis, bool upper, double at, double velocity, WallGrip grip) {
      walls.push_back(std::make_unique<RigidWall<2>>(WallPlacement{axis, upper, at},
                                                     WallMotion{velocity, 0}, grip, book));
    };
    add(0, true, 22 * cell, -speed, WallGrip::stick);
    add(0, false, 4 * cell, 0, WallGrip::stick);
    add(1, false, 4 * cell, 0, WallGrip::slip);
    add(1, true, 16 * cell, 0, WallGrip::slip);
    const std::vector<Block> blocks{{{4, 4}, {9, 12}, {0, 0}},
                                    {{15, 6}, {7, 8}, {-speed, 0.4 * speed}}};
    return {decomposition, GetParam(), blocks, std::move(walls)};
  }
  static BlockRun alone() { return make({MPI_COMM_SELF, grid(), {0, 0}, {}, {}}); }

  /// Another map every time.
  static Ownership<2> next_map(int round)
  {
    const int ranks = ranks_of(MPI_COMM_WORLD);
    switch (round % 3) {
      case 0:
        return metis_blocks(grid(), ranks);
      case 1:
        return scattered_blocks(grid(), 3, ranks, unsigned(round));
      default:
        return weighted_cuts<2>(grid(), ranks, two_rows(), {}, {});
    }
  }
};

// The run is elastic and smooth, so that rounding grows only slowly: 1e-9 leaves three digits.
TEST_P(PressedBlocks, AreAtTheSamePlacesOnAnyNumberOfRanks)
{
  BlockRun run = make({MPI_COMM_WORLD, grid(), two_rows(), {}, {}});
  run.advance(steps, share, speed);
  expect_same_on_one_rank(run, alone(), steps, share, speed, 1e-9);
}

TEST_P(PressedBlocks, AreAtTheSamePlacesWhileTheBordersMoveEveryFewSteps)
{
  constexpr int interval = 4;
  BlockRun run = make({MPI_COMM_WORLD, grid(), two_rows(), {}, {}});
  const Gathered start = run.gather();
  GlobalIndex sent = 0;
  for (int round = 0; round < steps / interval; ++round) {
    const Gathered before = run.gather();
    sent += run.stepper().repartition(next_map(round));
    const Gathered after = run.gather();  // the same bits, held by one rank each
    EXPECT_THAT(after.holders, ::testing::Each(1));
    EXPECT_EQ(after.mass, start.mass);
    EXPECT_EQ(after.position, before.position);
    EXPECT_EQ(after.velocity, before.velocity);
    run.advance(interval, share, speed);
  }
  sum_over_ranks(MPI_COMM_WORLD, std::span(&sent, 1));
  EXPECT_EQ(sent > 0, ranks_of(MPI_COMM_WORLD) > 1);
  expect_same_on_one_rank(run, alone(), steps, share, speed, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Methods, PressedBlocks,
                         ::testing::Values(Method{gimp, flip, "musl"},
                                           Method{quadratic, tpic, "musl"},
                                           Method{gimp, flip, "usf"},
                                           Method{quadratic, flip, "usf"},
                                           Method{gimp, flip, "usl"}, Method{gimp, fmpm, "musl"},
                                           Method{gimp, xpic, "musl"}, Method{cubic, flip, "musl"},
                                           Method{cpdi, flip, "musl"}, Method{cpdi, fmpm, "usf"},
                                           Method{cpdi, flip, "usl"}),
                         [](const auto& info) { return name_of(info.param); });

/// Steps until the run stops; its words. Collective.
std::string words_of_failure(BlockRun& run, double speed)
{
  try {
    run.advance(4000, 0.4, speed);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "no failure";
}

TEST(LostParticle, StopsEveryRankInTheSameStepWithTheSameWords)
{
  constexpr double speed = 150;
  BlockRun run(MPI_COMM_WORLD, two_rows(), {24, 20}, {gimp, flip, "musl"},
               {{{12, 9}, {4, 3}, {speed, 0}}}, {});
  const std::string words = words_of_failure(run, speed);
  EXPECT_THAT(words, HasSubstr("left the grid"));
  EXPECT_THAT(words, HasSubstr("of body 'block'"));
  EXPECT_THAT(words, HasSubstr("(150, "));
  EXPECT_THAT(words, HasSubstr("grid.margin"));

  std::string first = words;
  first.resize(1000, ' ');
  MPI_Bcast(first.data(), int(first.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
  first.resize(words.size());
  EXPECT_EQ(words, first);
  const double steps = double(run.stepper().steps());
  EXPECT_EQ(largest_over_ranks(MPI_COMM_WORLD, steps), steps);
}

TEST(LostParticle, IsNotForgottenWhereBordersMoveBeforeTheNextCheck)
{
  constexpr double speed = 150;
  BlockRun run(MPI_COMM_WORLD, two_rows(), {24, 20}, {gimp, flip, "musl"},
               {{{12, 9}, {4, 3}, {speed, 0}}}, {});
  std::string words;
  for (int step = 0; step < 1000 && words.empty(); ++step) try {
      run.advance(1, 0.4, speed);
      run.stepper().repartition(run.stepper().decomposition().ownership());
    } catch (const NumericalError& error) {
      words = error.what();
    }
  EXPECT_THAT(words, HasSubstr("left the grid"));
}

TEST(LostParticle, StepOfMoreThanACellIsNamed)
{
  BlockRun run(MPI_COMM_WORLD, two_rows(), {40, 20}, {gimp, flip, "musl"},
               {{{4, 4}, {30, 10}, {1000, 1000}}}, {});
  try {
    run.stepper().step(2.5 * cell / 1000);
    run.stepper().check();
    EXPECT_EQ(ranks_of(MPI_COMM_WORLD), 1) << "one rank's particles may go anywhere on the grid";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("moved by more than a cell in one step"));
    EXPECT_THAT(error.what(), HasSubstr("numerics.cfl"));
  }
}

TEST(LostParticle, PositionThatIsNoNumberIsNamed)
{
  BlockRun run(MPI_COMM_WORLD, two_rows(), {24, 20}, {gimp, flip, "musl"},
               {{{5, 5}, {8, 8}, {std::nan(""), 0}}}, {});
  EXPECT_THAT(words_of_failure(run, 1), HasSubstr("is no longer a number"));
}

}  // namespace
}  // namespace mpm
