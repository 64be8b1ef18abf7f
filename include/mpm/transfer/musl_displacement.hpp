#pragma once
#include <mpm/transfer/musl.hpp>

namespace mpm {

/// MUSL, but particles move by the velocities that their strain sees: both are of one displacement
/// of the nodes (Jassim, Stolle & Vermeer 2013, IJNAMG 37:2502). Else what the re-mapping filters
/// out of a velocity displaces particles without straining them.
struct MuslDisplacement {
  static constexpr UpdateOrderRow row{
      .keyword = "musl_displacement",
      .help = "as musl, and particles move by the re-mapped velocities too",
      .words = "MUSL with one displacement",
      .remaps = true};

  template <class Step>
  static void step(Step& s, double dt)
  {
    Musl::step_with(s, dt, [&](const auto& part, const auto& bounds) {
      return s.transfer.musl_displacement(part, s.grid(), s.fields_of(part), dt, bounds);
    });
  }
};

}  // namespace mpm
