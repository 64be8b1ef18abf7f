#pragma once
#include <mpm/transfer/order.hpp>

namespace mpm {

/// Update stress first: the stress sees the velocity before the forces.
struct Usf {
  static constexpr UpdateOrderRow row{.keyword = "usf",
                                      .help = "stress before the forces",
                                      .words = "USF",
                                      .begins_with_force = false,
                                      .stress_moment = -0.5};

  /// Of the present velocities, with the forces that follow.
  template <class Step>
  static void update_stress(Step& s, double dt)
  {
    using Fields = typename Step::Fields;
    for (Fields& field : s.fields) field.gradient_from_momentum(s.grid().runs());
    s.constrain_gradient(0);
    s.average_divergence();
    s.exchange.pass_and_sum(
        s.bodies, s.columns({&Fields::force_column}), s.moment, [&](const auto& part) {
          return s.transfer.usf_stress(part, s.grid(), s.fields_of(part), dt);  // sigma_p; f_i
        });
  }

  template <class Step>
  static void step(Step& s, double dt)
  {
    using Fields = typename Step::Fields;
    update_stress(s, dt);
    s.update_velocity(dt);

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // v_p, x_p; m_i, (mv)_i
          return s.with_forces(
              part, dt, s.transfer.usf_velocity(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace mpm
