/// A run that is saved and loaded into another one goes on as if nothing had been, to the last bit.

#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>
#include <mpm/stepping/load_balance.hpp>

#include <cmath>
#include <cstring>

#include "flying_block.hpp"
#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace testing_blocks;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double speed = 60;  // m/s
/// Not one after which the ranks agree, nor one after which particles are sorted.
constexpr int steps_before = 149;
/// Over several checks, and more than one sort.
constexpr int steps_after = 110;

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}

MemoryArchive saved(BlockRun& run)
{
  MemoryArchive archive;
  archive.start_saving();
  run.stepper().archive(archive);
  return archive;
}

/// All of it: what is saved is what is loaded.
void load(MemoryArchive& archive, BlockRun& run)
{
  archive.start_loading();
  run.stepper().archive(archive);
  EXPECT_THAT(archive.unread(), IsEmpty());
}

void step(BlockRun& run, int steps)
{
  const double wave_speed = run.stepper().bodies().front().law->wave_speed();
  for (int k = 0; k < steps; ++k) run.stepper().step(0.4 * cell / (wave_speed + speed));
}

/// Every column of every particle in its place, the reactions, and what the ranks agreed on.
void expect_same_bits(BlockRun& a, BlockRun& b)
{
  const auto equal = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  ASSERT_EQ(a.stepper().bodies().size(), b.stepper().bodies().size());
  for (std::size_t body = 0; body < a.stepper().bodies().size(); ++body) {
    const ParticleStore& p = a.stepper().bodies()[body].particles;
    const ParticleStore& q = b.stepper().bodies()[body].particles;
    ASSERT_THAT(p.ids(), ::testing::ElementsAreArray(q.ids()));
    int different = 0;
    for (LocalIndex k = 0; k < p.size(); ++k) {
      for (int c = 0; c < p.motion().width(); ++c)
        different += !equal(p.motion()(c, k), q.motion()(c, k));
      for (int c = 0; c < p.state().width(); ++c)
        different += !equal(p.state()(c, k), q.state()(c, k));
    }
    EXPECT_EQ(different, 0) << "values of body " << body;
    for (LocalIndex lane = p.size(); lane < p.blocks() * lane_count; ++lane)
      for (int d = 0; d < 2; ++d)  // padding moves with the last particle
        EXPECT_EQ(p.motion()(d, lane), q.motion()(d, lane)) << "padding of body " << body;
  }
  const Agreed &x = a.stepper().agreed(), &y = b.stepper().agreed();
  EXPECT_EQ(x.largest_speed, y.largest_speed);
  EXPECT_EQ(x.wave_speed, y.wave_speed);
  EXPECT_EQ(x.busiest_work, y.busiest_work);
  EXPECT_EQ(a.stepper().time(), b.stepper().time());
  EXPECT_EQ(a.stepper().steps(), b.stepper().steps());
  EXPECT_EQ(a.stepper().counters().migrated, b.stepper().counters().migrated);
  EXPECT_EQ(a.stepper().counters().messages, b.stepper().counters().messages);
  EXPECT_EQ(a.stepper().counters().bytes, b.stepper().counters().bytes);
  // Nodes, sums and orders too; waiting is a time by the clock.
  std::vector<std::string> names = differences(saved(a), saved(b));
  std::erase(names, "counters/waiting_seconds");
  EXPECT_THAT(names, IsEmpty());
}

class SavedRun : public ::testing::TestWithParam<Method> {
 protected:
  /// A piston, an edge, walls that push, a block that flows and one that flies into it.
  static BlockRun pressed(const Ownership<2>& ownership)
  {
    const ReactionBook book = GetParam().scheme->book;
    BlockRun::Conditions walls;
    const auto add = [&](bool upper, double at, double velocity) {
      walls.push_back(std::make_unique<RigidWall<2>>(
          WallPlacement{0, upper, at}, WallMotion{velocity, 0}, WallGrip::stick, book));
    };
    add(true, 26 * cell, -speed);
    add(false, 4 * cell, 0);
    // And two that push the first block from below and above.
    for (const bool upper : {false, true})
      walls.push_back(std::make_unique<RigidWall<2>>(
          WallPlacement{1, upper, (upper ? 17 : 4) * cell}, WallMotion{}, WallGrip::contact, book,
          WallStiffness<2>{0.5, Vec<2>::Constant(0.5 * cell)}));
    const YieldConstants yield{0.01 * youngs_modulus, 0.1 * youngs_modulus};
    return {{MPI_COMM_WORLD, ownership},
            GetParam(),
            {{{4, 4}, {9, 13}, {0, 0}, yield}, {{14, 5}, {12, 9}, {-speed, 0.4 * speed}}},
            std::move(walls)};
  }
  /// Blocks on their way across the seam of a periodic axis, the second one all at once.
  static BlockRun flying(const Ownership<2>& ownership)
  {
    return {{MPI_COMM_WORLD, ownership},
            GetParam(),
            {{{23, 3}, {7, 5}, {speed, speed}}, {{27, 14}, {3, 3}, {speed, 0}}},
            {}};
  }
  static GridGeometry<2> grid(bool periodic)
  {
    GridGeometry<2> grid = BlockRun::grid_of({30, 24});
    grid.periodic[0] = periodic;
    return grid;
  }
  static std::vector<Ownership<2>> maps(bool periodic)
  {
    return {weighted_cuts<2>(grid(periodic), ranks(), {0, 0}, {}, {}),
            scattered_blocks(grid(periodic), 5, ranks(), 3)};
  }

  template <class Make>
  static void expect_the_same_after_loading(const Make& make)
  {
    BlockRun run = make();
    step(run, steps_before);
    GlobalIndex migrated = run.stepper().counters().migrated;
    sum_over_ranks(MPI_COMM_WORLD, std::span(&migrated, 1));
    EXPECT_EQ(migrated > 0, ranks() > 1);
    MemoryArchive archive = saved(run);
    BlockRun anew = make();
    load(archive, anew);
    expect_same_bits(run, anew);
    step(run, steps_after);
    for (int time = 0; time < 2; ++time) {  // the second time into a run that has gone on
      load(archive, anew);
      EXPECT_THAT(differences(archive, saved(anew)), IsEmpty());
      step(anew, steps_after);
      expect_same_bits(run, anew);
    }
    auto& conditions = run.stepper().slots().conditions;
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      const Reaction<2> reaction = conditions[k]->take_reaction();
      const Reaction<2> again = anew.stepper().slots().conditions[k]->take_reaction();
      EXPECT_EQ(reaction.impulse, again.impulse);
      EXPECT_EQ(reaction.work, again.work);
    }
  }
};

TEST_P(SavedRun, GoesOnWithTheSameBitsWhenItIsPressed)
{
  for (const Ownership<2>& map : maps(false))
    expect_the_same_after_loading([&] { return pressed(map); });
}

TEST_P(SavedRun, GoesOnWithTheSameBitsOnAPeriodicAxis)
{
  for (const Ownership<2>& map : maps(true))
    expect_the_same_after_loading([&] { return flying(map); });
}

INSTANTIATE_TEST_SUITE_P(
    Methods, SavedRun,
    ::testing::Values(Method{"gimp", "flip", "musl"}, Method{"quadratic", "apic", "musl"},
                      Method{"gimp", "flip", "usf"}, Method{"gimp", "flip", "usl"},
                      Method{"gimp", "flip", "usavg"}, Method{"gimp", "flip", "musl_displacement"},
                      Method{"cubic", "fmpm", "musl"}, Method{"cpdi", "flip", "musl"}),
    [](const auto& info) { return name_of(info.param); });

TEST(SavedLoadBalance, MovesTheBordersAtTheSameStepsToTheSamePlaces)
{
  const GridGeometry<2> grid = BlockRun::grid_of({50, 50});
  const auto make = [](const Ownership<2>& ownership) {
    return BlockRun({MPI_COMM_WORLD, ownership}, {"gimp", "flip", "musl"},
                    {{{4, 4}, {20, 20}, {speed, speed}}}, {});
  };
  const auto advance = [](BlockRun& run, LoadBalance<2>& balance, int steps) {
    for (int k = 0; k < steps; ++k) {
      step(run, 1);
      balance.look(run.stepper());
    }
  };
  const auto archive_both = [](MemoryArchive& archive, BlockRun& run, LoadBalance<2>& balance) {
    const Archive::Section section(archive, "run");
    run.stepper().archive(archive);
    balance.archive(archive);
  };
  // When it pays, in the midst of a row of checks; and every so many steps.
  for (const GlobalIndex interval : {0, 35}) {
    BlockRun run = make(weighted_cuts<2>(grid, ranks(), {0, 0}, {}, {}));
    LoadBalance<2> balance({}, interval);
    advance(run, balance, 110);
    const GlobalIndex before = balance.repartitions();
    MemoryArchive archive;
    archive.start_saving();
    archive_both(archive, run, balance);
    BlockRun anew = make(run.stepper().decomposition().ownership());
    LoadBalance<2> other({}, interval);
    archive.start_loading();
    archive_both(archive, anew, other);
    EXPECT_THAT(archive.unread(), IsEmpty());

    advance(run, balance, 110);
    advance(anew, other, 110);
    EXPECT_EQ(balance.repartitions() > before, ranks() > 1);
    EXPECT_EQ(other.repartitions(), balance.repartitions());
    EXPECT_EQ(other.mean_imbalance(), balance.mean_imbalance());
    EXPECT_EQ(other.mean_work_imbalance(), balance.mean_work_imbalance());
    for_each_index(IndexBox<2>{{0, 0}, grid.nodes}, [&](const IndexVec<2>& cell) {
      EXPECT_EQ(anew.stepper().decomposition().owner_of_cell(cell),
                run.stepper().decomposition().owner_of_cell(cell));
    });
    expect_same_bits(run, anew);
  }
}

TEST(SavedState, ComesBackIntoItsRunAfterTheBordersHaveMoved)
{
  const GridGeometry<2> grid = BlockRun::grid_of({50, 50});
  const Ownership<2> borders = weighted_cuts<2>(grid, ranks(), {0, 0}, {}, {});
  BlockRun run({MPI_COMM_WORLD, borders}, {"gimp", "flip", "musl"},
               {{{4, 4}, {20, 20}, {speed, speed}}}, {});
  step(run, steps_before);
  MemoryArchive archive = saved(run);
  step(run, steps_after);
  MemoryArchive expected = saved(run);
  for (int time = 0; time < 2; ++time) {
    run.stepper().repartition(scattered_blocks(grid, 5, ranks(), 3));
    step(run, 30);
    run.stepper().begin_loading(borders);
    load(archive, run);
    step(run, steps_after);
    std::vector<std::string> names = differences(expected, saved(run));
    std::erase(names, "counters/waiting_seconds");
    EXPECT_THAT(names, IsEmpty());
  }
}

TEST(SavedLoss, IsToldInTheSameWordsByTheRunThatLoadsIt)
{
  const auto make = [] {
    return BlockRun(MPI_COMM_WORLD, {0, 0}, {24, 20}, {"gimp", "flip", "musl"},
                    {{{12, 9}, {4, 3}, {2.5 * speed, 0}}}, {});
  };
  const auto words_of_step = [](BlockRun& run) -> std::string {
    try {
      step(run, 1);
    } catch (const NumericalError& error) {
      return error.what();
    }
    return "";
  };
  BlockRun run = make();
  MemoryArchive archive;
  std::string words;
  while (words.empty() && run.stepper().steps() < 2000) {
    archive = saved(run);
    words = words_of_step(run);
  }
  EXPECT_THAT(words, HasSubstr("left the grid"));
  // Lost before the state was saved, said in the check after it.
  EXPECT_THAT(words, Not(HasSubstr("in step " + std::to_string(run.stepper().steps()) + ",")));
  BlockRun anew = make();
  load(archive, anew);
  EXPECT_EQ(words_of_step(anew), words);
}

TEST(SavedState, IsRefusedOnAnotherPartOfTheGridAndByOtherBodies)
{
  const Method musl{"gimp", "flip", "musl"};
  const std::vector<Block> blocks{{{4, 4}, {5, 5}, {0, 0}}};
  const auto words_of_loading = [](MemoryArchive& archive, BlockRun other) -> std::string {
    archive.start_loading();
    try {
      other.stepper().archive(archive);
    } catch (const InputError& error) {
      return error.what();
    }
    return "loaded";
  };
  BlockRun run(MPI_COMM_WORLD, {ranks(), 1}, {24, 20}, musl, blocks, {});
  MemoryArchive archive = saved(run);
  EXPECT_THAT(words_of_loading(archive, {MPI_COMM_WORLD, {ranks(), 1}, {24, 21}, musl, blocks, {}}),
              HasSubstr("another part of the grid"));
  if (ranks() > 1) {
    EXPECT_THAT(
        words_of_loading(archive, {MPI_COMM_WORLD, {1, ranks()}, {24, 20}, musl, blocks, {}}),
        HasSubstr("another part of the grid"));
  }
  std::vector<Block> more = blocks;
  more.push_back({{12, 4}, {5, 5}, {0, 0}});
  EXPECT_THAT(words_of_loading(archive, {MPI_COMM_WORLD, {ranks(), 1}, {24, 20}, musl, more, {}}),
              HasSubstr("body1/id is not there"));
  // A law with a state of its own.
  more = blocks;
  more[0].yield = YieldConstants{1e6};
  EXPECT_THAT(words_of_loading(archive, {MPI_COMM_WORLD, {ranks(), 1}, {24, 20}, musl, more, {}}),
              HasSubstr("body0/state/"));
}

}  // namespace
}  // namespace mpm
