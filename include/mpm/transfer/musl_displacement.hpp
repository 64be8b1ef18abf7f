#pragma once
#include <mpm/transfer/order.hpp>

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
    using Fields = typename Step::Fields;
    s.update_velocity(dt);  // v_i = ((mv)_i + dt f_i) / m_i
    s.remap_velocity();     // v_p, and back: (mv)_i
    s.constrain_gradient(dt);
    s.average_divergence();

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_force_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // sigma_p, x_p; m_i, (mv)_i, f_i
          return s.with_loads(
              part, dt,
              s.transfer.musl_displacement(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace mpm
