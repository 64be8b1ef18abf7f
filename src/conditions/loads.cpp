#include <mpm/conditions/loads.hpp>

#include <algorithm>

namespace mpm {

template <int Dim>
Loads<Dim>::Loads(std::vector<std::unique_ptr<Load<Dim>>> loads) : loads_(std::move(loads))
{
  for (const auto& load : loads_) on_particles_ = on_particles_ || load->acts_on_particles();
}

template <int Dim>
std::vector<SurfaceMark<Dim>> Loads<Dim>::marks() const
{
  std::vector<SurfaceMark<Dim>> marks;
  for (const auto& load : loads_)
    if (auto mark = load->mark()) marks.push_back(*std::move(mark));
  return marks;
}

template <int Dim>
bool Loads<Dim>::need_initial_position() const
{
  return std::ranges::any_of(loads_,
                             [](const auto& load) { return load->needs_initial_position(); });
}

template <int Dim>
void Loads<Dim>::scatter(const BodyPart<Dim>& part, const Transfer<Dim>& transfer,
                         const GridTopology<Dim>& grid, NodeFields<Dim>& fields, double time) const
{
  if (!on_particles_) return;
  transfer.outside_force(part, grid, fields.load_force_column(),
                         [&](LocalIndex block, Lanes(&force)[Dim]) {
                           for (const auto& load : loads_)
                             load->add_to_particles(part.body, block, time, force);
                           return true;
                         });
}

template <int Dim>
void Loads<Dim>::apply(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields, double time,
                       double dt) const
{
  if (loads_.empty()) return;
  for (const auto& load : loads_) load->add_to_nodes(nodes, runs, fields, time, dt);
  fields.add_load_force(runs);
}

/// visit(axis, impulse of the loads, the node's updated velocities) for all owned nodes.
template <int Dim>
template <class Visit>
void Loads<Dim>::for_each_impulse(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields,
                                  double dt, Visit visit)
{
  if (loads_.empty()) return;
  for (const NodeRun<Dim>& run : runs)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node) {
      if (!nodes.is_owned(node) || !fields.is_active(node)) continue;
      for (int d = 0; d < Dim; ++d)
        visit(d, dt * fields.load_force[std::size_t(node) * Dim + d], fields.updated_of(node));
    }
}

template <int Dim>
void Loads<Dim>::book(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields, double dt)
{
  for_each_impulse(nodes, runs, fields, dt, [&](int d, double impulse, const double* u) {
    reaction_.impulse[d] += impulse;
    reaction_.work += impulse * (u[d] - 0.5 * u[Dim + d]);
  });
}

template <int Dim>
void Loads<Dim>::book_residual(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields,
                               double dt)
{
  for_each_impulse(nodes, runs, fields, dt, [&](int d, double impulse, const double* u) {
    reaction_.work += impulse * u[Dim + d];
  });
}

template <int Dim>
double Loads<Dim>::largest_step() const
{
  double step = std::numeric_limits<double>::infinity();
  for (const auto& load : loads_) step = std::min(step, load->largest_step());
  return step;
}

template class Loads<2>;
template class Loads<3>;

}  // namespace mpm
