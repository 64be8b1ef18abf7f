#pragma once
#include <mpm/transfer/usf.hpp>

namespace mpm {

/// Update stress averaged: one half of the step's strain before the forces, of the velocities that
/// they find, and one half after, of the particles' new velocities, mapped back (Bardenhagen 2002,
/// JCP 180:383; Nairn 2003, CMES 4:649). Stress and velocity stand at the same moment between
/// steps.
struct Usavg {
  static constexpr UpdateOrderRow row{.keyword = "usavg",
                                      .help = "half of the strain before the forces, half after",
                                      .words = "USAVG",
                                      .remaps = true,
                                      .begins_with_force = false,
                                      .stress_moment = 0};

  template <class Step>
  static void step(Step& s, double dt)
  {
    using Fields = typename Step::Fields;
    Usf::update_stress(s, 0.5 * dt);
    s.update_velocity(dt);
    s.remap_velocity();
    s.constrain_gradient(dt);
    s.average_divergence();

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // sigma_p of the other half, x_p; m_i, (mv)_i
          return s.with_forces(
              part, dt, s.transfer.usavg_stress(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace mpm
