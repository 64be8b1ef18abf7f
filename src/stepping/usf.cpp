#include <mpm/stepping/update_order.hpp>

namespace mpm {

namespace {

template <int Dim>
class Usf final : public UpdateOrder<Dim> {
  using Fields = NodeFields<Dim>;

 public:
  bool begins_with_force() const override { return false; }
  double stress_moment() const override { return -0.5; }

  void step(Step<Dim>& s, double dt) const override
  {
    for (Fields& field : s.fields) field.gradient_from_momentum(s.grid().runs());
    s.constrain_gradient(0);
    s.exchange.pass_and_sum(s.bodies, s.columns({&Fields::force_column}), [&](const auto& part) {
      s.transfer.usf_stress(part, s.grid(), s.fields_of(part), dt);  // sigma_p; f_i
    });
    s.update_velocity(dt);

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // v_p, x_p; m_i, (mv)_i
          return s.with_loads(
              part, dt, s.transfer.usf_velocity(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace

template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_usf()
{
  return std::make_unique<Usf<Dim>>();
}

template std::unique_ptr<UpdateOrder<2>> make_usf();
template std::unique_ptr<UpdateOrder<3>> make_usf();

}  // namespace mpm
