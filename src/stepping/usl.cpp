#include <mpm/stepping/update_order.hpp>

namespace mpm {

namespace {

template <int Dim>
class Usl final : public UpdateOrder<Dim> {
  using Fields = NodeFields<Dim>;

 public:
  void step(Step<Dim>& s, double dt) const override
  {
    s.update_velocity(dt);
    for (Fields& field : s.fields) field.gradient_from_updated(s.grid().runs());

    s.reset();
    s.exchange.move_and_sum(
        s.bodies, s.sums({&Fields::mass_column, &Fields::momentum_force_column}), s.moment, dt,
        [&](const auto& part, const auto& bounds) {
          // all at once
          return s.with_loads(part, dt,
                              s.transfer.usl(part, s.grid(), s.fields_of(part), dt, bounds));
        });
  }
};

}  // namespace

template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_usl()
{
  return std::make_unique<Usl<Dim>>();
}

template std::unique_ptr<UpdateOrder<2>> make_usl();
template std::unique_ptr<UpdateOrder<3>> make_usl();

}  // namespace mpm
