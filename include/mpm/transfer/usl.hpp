#pragma once
#include <mpm/transfer/order.hpp>

namespace mpm {

/// Update stress last: the stress sees the velocity that the forces have changed.
struct Usl {
  static constexpr UpdateOrderRow row{
      .keyword = "usl",
      .help = "stress after the forces, from the velocities that they changed",
      .words = "USL",
      .stable_cfl = &StableCfl::stress_last};

  template <class Step>
  static void step(Step& s, double dt)
  {
    using Fields = typename Step::Fields;
    s.update_velocity(dt);
    for (Fields& field : s.fields) field.gradient_from_updated(s.grid().runs());
    s.average_divergence();

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_force_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // all at once
          return s.with_forces(part, dt,
                               s.transfer.usl(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace mpm
