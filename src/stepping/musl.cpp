#include <mpm/stepping/update_order.hpp>

namespace mpm {

namespace {

template <int Dim>
class Musl final : public UpdateOrder<Dim> {
  using Fields = NodeFields<Dim>;

 public:
  typename Fields::Needs needs() const override { return {.remap = true}; }

  void step(Step<Dim>& s, double dt) const override
  {
    s.update_velocity(dt);  // v_i = ((mv)_i + dt f_i) / m_i
    for (Fields& field : s.fields) field.reset_remap(s.grid().runs());
    s.exchange.pass_and_sum(s.bodies, s.columns({&Fields::remap_column}), [&](const auto& part) {
      s.transfer.musl_velocity(part, s.grid(), s.fields_of(part));  // v_p, and back: (mv)_i
    });
    for (Fields& field : s.fields) field.gradient_from_remap(s.grid().runs());
    s.constrain_gradient(dt);

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_force_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // sigma_p, x_p; m_i, (mv)_i, f_i
          return s.with_loads(
              part, dt, s.transfer.musl_stress(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace

template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_musl()
{
  return std::make_unique<Musl<Dim>>();
}

template std::unique_ptr<UpdateOrder<2>> make_musl();
template std::unique_ptr<UpdateOrder<3>> make_musl();

}  // namespace mpm
