#include <mpm/grid/node_fields.hpp>

#include <algorithm>

namespace mpm {

namespace {

template <int Dim, class Visit>
void for_each_node(std::span<const NodeRun<Dim>> runs, Visit visit)
{
  for (const NodeRun<Dim>& run : runs)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node) visit(node);
}

void zero(LaneVector<double>& values, LocalIndex first, LocalIndex count, int width)
{
  std::fill_n(values.begin() + std::size_t(first) * width, std::size_t(count) * width, 0.0);
}

}  // namespace

template <int Dim>
NodeFields<Dim>::NodeFields(LocalIndex nodes, const Needs& needs, double mass_cut)
    : mass_cut_(mass_cut)
{
  // Rows of node masses are added four at a time: room for the last row's tail.
  if constexpr (!mass_slot) mass.assign(nodes + 4, 0.0);
  momentum_force.assign(std::size_t(nodes) * record_width, 0.0);
  updated.assign(std::size_t(nodes) * record_width, 0.0);
  if (needs.remap) remapped_momentum.assign(std::size_t(nodes) * remap_width, 0.0);
  if (needs.load_force) load_force.assign(std::size_t(nodes) * Dim, 0.0);
  if (needs.surface) surface.assign(std::size_t(nodes) * surface_width, 0.0);
  if (needs.gradient) gradient_velocity.assign(std::size_t(nodes) * velocity_width, 0.0);
}

template <int Dim>
void NodeFields<Dim>::reset(Runs runs)
{
  for (const NodeRun<Dim>& run : runs) {
    if constexpr (!mass_slot) zero(mass, run.first, run.length, 1);
    zero(momentum_force, run.first, run.length, record_width);
    if (!load_force.empty()) zero(load_force, run.first, run.length, Dim);
  }
}

template <int Dim>
void NodeFields<Dim>::reset_remap(Runs runs)
{
  for (const NodeRun<Dim>& run : runs) zero(remapped_momentum, run.first, run.length, remap_width);
}

template <int Dim>
void NodeFields<Dim>::reset_surface(Runs runs)
{
  for (const NodeRun<Dim>& run : runs) zero(surface, run.first, run.length, surface_width);
}

template <int Dim>
void NodeFields<Dim>::clear(std::span<const LocalIndex> nodes)
{
  for (const LocalIndex node : nodes) {
    mass_of(node) = 0;
    zero(momentum_force, node, 1, record_width);
    zero(updated, node, 1, record_width);
    if (!remapped_momentum.empty()) zero(remapped_momentum, node, 1, remap_width);
    if (!load_force.empty()) zero(load_force, node, 1, Dim);
    if (!surface.empty()) zero(surface, node, 1, surface_width);
    if (!gradient_velocity.empty()) zero(gradient_velocity, node, 1, velocity_width);
  }
}

template <int Dim>
void NodeFields<Dim>::add_load_force(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    for (int d = 0; d < Dim; ++d) force_of(node)[d] += load_force[std::size_t(node) * Dim + d];
  });
}

template <int Dim>
void NodeFields<Dim>::update_velocity(Runs runs, double dt)
{
  for_each_node(runs, [&](LocalIndex node) {
    const double inverse_mass = is_active(node) ? 1.0 / mass_of(node) : 0.0;
    const double* mf = &momentum_force[std::size_t(node) * record_width];
    double* u = &updated[std::size_t(node) * record_width];
    for (int d = 0; d < Dim; ++d) {
      const double increment = dt * mf[Dim + d] * inverse_mass;
      u[d] = mf[d] * inverse_mass + increment;
      u[Dim + d] = increment;
    }
  });
}

template <int Dim>
void NodeFields<Dim>::carry_momentum(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    for (int d = 0; d < Dim; ++d)
      momentum_force[std::size_t(node) * record_width + d] = mass_of(node) * updated_of(node)[d];
  });
}

template <int Dim>
void NodeFields<Dim>::begin_refinement(Runs runs, bool before_forces)
{
  for_each_node(runs, [&](LocalIndex node) {
    double* u = updated_of(node);
    for (int d = 0; d < Dim; ++d) u[Dim + d] = u[d] - (before_forces ? u[Dim + d] : 0);
  });
}

template <int Dim>
void NodeFields<Dim>::refine(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    const double inverse_mass = is_active(node) ? 1.0 / mass_of(node) : 0.0;
    const double* momentum = &remapped_momentum[std::size_t(node) * remap_width];
    double *u = updated_of(node), *before = gradient_velocity_of(node);
    for (int d = 0; d < Dim; ++d) {
      before[d] = u[d];
      u[d] += u[Dim + d] - momentum[d] * inverse_mass;
    }
  });
}

template <int Dim>
void NodeFields<Dim>::end_refinement(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    double *u = updated_of(node), *before = gradient_velocity_of(node);
    for (int d = 0; d < Dim; ++d) u[Dim + d] = u[d] - before[d];
  });
}

template <int Dim>
void NodeFields<Dim>::divergence_from_remap(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    remapped_momentum[std::size_t(node) * remap_width] *=
        is_active(node) ? 1.0 / mass_of(node) : 0.0;
  });
}

template <int Dim>
void NodeFields<Dim>::set_gradient_velocity(LocalIndex node, int component, double value)
{
  double* v = gradient_velocity_of(node);
  v[component] = value;
  if constexpr (Dim == 2) v[Dim + component] = value;
}

template <int Dim>
void NodeFields<Dim>::gradient_from_momentum(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    const double inverse_mass = is_active(node) ? 1.0 / mass_of(node) : 0.0;
    const double* momentum = &momentum_force[std::size_t(node) * record_width];
    for (int d = 0; d < Dim; ++d) set_gradient_velocity(node, d, momentum[d] * inverse_mass);
  });
}

template <int Dim>
void NodeFields<Dim>::gradient_from_remap(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    const double inverse_mass = is_active(node) ? 1.0 / mass_of(node) : 0.0;
    const double* momentum = &remapped_momentum[std::size_t(node) * remap_width];
    for (int d = 0; d < Dim; ++d) set_gradient_velocity(node, d, momentum[d] * inverse_mass);
  });
}

template <int Dim>
void NodeFields<Dim>::gradient_from_updated(Runs runs)
{
  for_each_node(runs, [&](LocalIndex node) {
    for (int d = 0; d < Dim; ++d)
      set_gradient_velocity(node, d, updated[std::size_t(node) * record_width + d]);
  });
}

template <int Dim>
void NodeFields<Dim>::archive(Archive& archive, std::span<const std::int64_t> rows)
{
  // Without the tail's room.
  const std::size_t masses = mass.empty() ? 0 : updated.size() / record_width;
  archive.rows("mass", rows, std::span(mass).first(masses));
  archive.rows("momentum_force", rows, momentum_force);
  archive.rows("updated", rows, updated);
  archive.rows("remapped_momentum", rows, remapped_momentum);
  archive.rows("load_force", rows, load_force);
  archive.rows("gradient_velocity", rows, gradient_velocity);
}

template <int Dim>
std::size_t NodeFields<Dim>::bytes() const
{
  return (mass.size() + momentum_force.size() + updated.size() + remapped_momentum.size() +
          load_force.size() + gradient_velocity.size() + surface.size()) *
         sizeof(double);
}

template class NodeFields<2>;
template class NodeFields<3>;

}  // namespace mpm
