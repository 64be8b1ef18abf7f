/// A history that is saved with its run and loaded goes on with the same lines, to the last bit.

#include <mpm/core/memory_archive.hpp>
#include <mpm/simulation/history.hpp>

#include "flying_block.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace testing_blocks;
using ::testing::IsEmpty;

constexpr double speed = 40;  // m/s
constexpr int steps_between_lines = 17;

/// A wood that flows and a load cell behind it, between piston and edge.
struct MeasuredRun {
  RigidWall<2>* piston = nullptr;
  RigidWall<2>* edge = nullptr;
  BlockRun run;
  History<2> history;

  MeasuredRun() : run(make()), history(run.stepper(), apparatus(), speed) { history.record(0); }

  BlockRun make()
  {
    BlockRun::Conditions walls;
    const auto add = [&](bool upper, double at, double velocity) {
      auto wall =
          std::make_unique<RigidWall<2>>(WallPlacement{0, upper, at}, WallMotion{velocity, 0},
                                         WallGrip::slip, ReactionBook::increments);
      RigidWall<2>* raw = wall.get();
      walls.push_back(std::move(wall));
      return raw;
    };
    piston = add(true, 16 * cell, -speed);
    edge = add(false, 4 * cell, 0);
    const YieldConstants yield{0.01 * youngs_modulus, 0.1 * youngs_modulus};
    return {MPI_COMM_WORLD,
            {0, 0},
            {24, 16},
            {"gimp", "flip", "musl"},
            {{{7, 4}, {9, 7}, {0, 0}, yield}, {{4, 4}, {3, 7}, {0, 0}}},
            std::move(walls)};
  }
  Apparatus<2> apparatus() const { return {piston, edge, {edge}, 0, 9 * cell, 7 * cell, 1}; }

  /// Lines at the same steps, whoever begins where.
  void advance(int steps)
  {
    const double dt = 0.4 * cell / (run.stepper().bodies().front().law->wave_speed() + speed);
    for (int k = 0; k < steps; ++k) {
      run.stepper().step(dt);
      history.observe();
      const GlobalIndex place = run.stepper().steps() % steps_between_lines;
      if (place == 0) {
        run.stepper().check();
        history.record(dt);
      }
      if (place == steps_between_lines - 1) history.before_line();
    }
  }
  void archive(MemoryArchive& archive)
  {
    run.stepper().archive(archive);
    const Archive::Section section(archive, "history");
    history.archive(archive);
  }
};

TEST(SavedHistory, GoesOnWithTheSameLines)
{
  // Between two lines; and when a line is due, which needs what was measured before the last step.
  for (const int steps : {5 * steps_between_lines + 7, 6 * steps_between_lines - 1}) {
    MeasuredRun measured;
    measured.advance(steps);
    MemoryArchive archive;
    archive.start_saving();
    measured.archive(archive);
    MeasuredRun anew;
    archive.start_loading();
    anew.archive(archive);
    EXPECT_THAT(archive.unread(), IsEmpty());

    measured.advance(60);
    anew.advance(60);
    const auto &lines = measured.history.lines(), &others = anew.history.lines();
    ASSERT_EQ(lines.size(), 1u + std::size_t(steps + 60) / steps_between_lines);
    ASSERT_EQ(others.size(), lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k)
      EXPECT_EQ(history_row(others[k], anew.history.kind()),
                history_row(lines[k], measured.history.kind()))
          << "line " << k;
    EXPECT_NE(lines.back().load_cell_stress, 0);
    EXPECT_NE(lines.back().energy_error, 0);
    EXPECT_GT(lines.back().plastic_work, 0);
    EXPECT_EQ(anew.history.deepest_behind_piston(), measured.history.deepest_behind_piston());
    MemoryArchive one, other;
    measured.archive(one);
    anew.archive(other);
    std::vector<std::string> names = differences(one, other);
    std::erase(names, "counters/waiting_seconds");
    EXPECT_THAT(names, IsEmpty());
  }
}

}  // namespace
}  // namespace mpm
