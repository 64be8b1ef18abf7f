#include <mpm/stepping/step.hpp>

#include <utility>

namespace mpm {

template <int Dim>
void Step<Dim>::find_surfaces()
{
  if (std::exchange(surfaces_found, true)) return;
  for (const auto& contact : slots.contacts) {
    if (!contact->needs_surfaces()) continue;
    const std::span<const char> asked = contact->meet(grid(), transfer.support(), fields);
    for (Fields& field : fields) field.reset_surface(grid().runs());
    exchange.pass_and_sum(bodies, columns({&Fields::surface_column}), moment,
                          [&](const BodyPart<Dim>& part) {
                            return transfer.surface(part, grid(), fields_of(part), asked);
                          });
    contact->measure(grid(), fields);
  }
}

template <int Dim>
void Step<Dim>::update_velocity(double dt)
{
  find_surfaces();
  for (NodeFields<Dim>& field : fields) {
    slots.loads.apply(grid(), grid().runs(), field, time(), dt);
    field.update_velocity(grid().runs(), dt);
  }
  for (const auto& contact : slots.contacts) contact->exchange_momentum(grid(), fields, time(), dt);
  for (NodeFields<Dim>& field : fields) {
    for (const auto& condition : slots.conditions)
      condition->constrain_updated(grid(), field, time(), dt);
    slots.loads.book(grid(), grid().runs(), field, dt);
  }
  for (const auto& contact : slots.contacts) contact->book(grid(), fields);
  for (const auto& condition : slots.conditions) condition->book_push(time(), dt);
  if (extras.refinements > 0) refine_velocity(dt);
}

/// What a condition takes from a residual is an impulse of its wall: the nodes keep its velocity,
/// and their residual is zero.
template <int Dim>
void Step<Dim>::refine_velocity(double dt)
{
  for (Fields& field : fields) field.begin_refinement(grid().runs(), extras.refine_before_forces);
  for (int k = 0; k < extras.refinements; ++k) {
    sum_remap(&Transfer<Dim>::refine_velocity);
    for (Fields& field : fields) {
      field.refine(grid().runs());
      for (const auto& condition : slots.conditions)
        condition->constrain_updated(grid(), field, time(), dt);
      field.end_refinement(grid().runs());
      slots.loads.book_residual(grid(), grid().runs(), field, dt);
    }
  }
}

template <int Dim>
void Step<Dim>::remap_velocity()
{
  sum_remap(&Transfer<Dim>::musl_velocity);
  for (Fields& field : fields) field.gradient_from_remap(grid().runs());
}

template <int Dim>
void Step<Dim>::constrain_gradient(double dt)
{
  find_surfaces();
  for (const auto& contact : slots.contacts) contact->exchange_gradient(grid(), fields, time(), dt);
  for (NodeFields<Dim>& field : fields)
    for (const auto& condition : slots.conditions)
      condition->constrain_gradient(grid(), field, time(), dt);
}

template <int Dim>
void Step<Dim>::sum_remap(RemapPass pass)
{
  for (Fields& field : fields) field.reset_remap(grid().runs());
  exchange.pass_and_sum(
      bodies, columns({&Fields::remap_column}), moment,
      [&](const BodyPart<Dim>& part) { return (transfer.*pass)(part, grid(), fields_of(part)); });
}

template <int Dim>
void Step<Dim>::average_divergence()
{
  if (!extras.f_bar) return;
  sum_remap(&Transfer<Dim>::divergence);
  for (Fields& field : fields) field.divergence_from_remap(grid().runs());
}

template <int Dim>
void Step<Dim>::reset()
{
  for (NodeFields<Dim>& field : fields) field.reset(grid().runs());
  for (const auto& condition : slots.conditions) condition->reset_push();
}

template <int Dim>
std::vector<NodeColumn> Step<Dim>::columns(std::initializer_list<ColumnOf> which) const
{
  std::vector<NodeColumn> list;
  for (NodeFields<Dim>& field : fields)
    for (const ColumnOf column : which) list.push_back((field.*column)());
  return list;
}

template <int Dim>
std::vector<NodeColumn> Step<Dim>::sums(std::initializer_list<ColumnOf> which) const
{
  std::vector<NodeColumn> list = columns(which);
  if (slots.loads.act_on_particles())
    for (NodeFields<Dim>& field : fields) list.push_back(field.load_force_column());
  return list;
}

template struct Step<2>;
template struct Step<3>;

}  // namespace mpm
