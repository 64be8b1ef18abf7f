#pragma once
#include <mpm/transfer/order.hpp>

namespace mpm {

/// Modified update stress last: the stress sees the particles' new velocities, mapped back.
struct Musl {
  static constexpr UpdateOrderRow row{.keyword = "musl",
                                      .help = "stress after the forces, from re-mapped velocities",
                                      .words = "MUSL",
                                      .remaps = true};

  template <class Step>
  static void step(Step& s, double dt)
  {
    step_with(s, dt, [&](const auto& part, const auto& bounds) {
      return s.transfer.musl_stress(part, s.grid(), s.fields_of(part), dt, bounds);
    });
  }

  /// stress(part, bounds): stress, move and sums of a part, once the gradient velocities stand.
  template <class Step, class Stress>
  static void step_with(Step& s, double dt, const Stress& stress)
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
          return s.with_forces(part, dt, stress(part, bounds));  // sigma_p, x_p; m_i, (mv)_i, f_i
        });
  }
};

}  // namespace mpm
