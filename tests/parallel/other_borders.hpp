#pragma once
/// Runs of a total Lagrangian step that go back to a saved state, within other borders.

#include <mpm/core/memory_archive.hpp>

#include "ragged_blocks.hpp"
#include <gtest/gtest.h>

namespace mpm {

/// Steps before a state is saved, from there to what is compared, and on within borders that it was
/// not saved in.
struct GoingBack {
  int before, compared, astray;
};

/// As where a run goes back, and where one begins (`anew`, as `run` was made) on the borders at the
/// start. Collective.
template <class Run>
void expect_taken_up_within_other_borders(Run& run, Run& anew, const GoingBack& steps)
{
  const auto first = run.stepper().decomposition().ownership();
  const auto scattered = [&](LocalIndex edge, unsigned seed) {
    return scattered_blocks(first.geometry(), edge, first.ranks(), seed);
  };
  for (const auto& borders : {first, scattered(3, 1)}) {
    run.stepper().repartition(borders);
    run.advance(steps.before);
    MemoryArchive archive;
    archive.start_saving();
    run.stepper().archive(archive);
    run.advance(steps.compared);
    const auto one = run.found();
    run.stepper().repartition(scattered(5, 7));
    run.advance(steps.astray);
    for (Run* again : {&run, &anew}) {
      again->stepper().begin_loading(borders);
      archive.start_loading();
      again->stepper().archive(archive);
      EXPECT_TRUE(archive.unread().empty());
      again->advance(steps.compared);
      const auto two = again->found();
      EXPECT_EQ(two.failed, one.failed);
      EXPECT_EQ(two.places, one.places);
      EXPECT_EQ(two.energy, one.energy);
    }
  }
}

}  // namespace mpm
