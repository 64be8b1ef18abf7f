#include <mpm/core/error.hpp>
#include <mpm/parallel/redistribution.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include <algorithm>
#include <numeric>

namespace mpm {

template <int Dim>
UpdatedLagrangian<Dim>::UpdatedLagrangian(Decomposition<Dim> decomposition, Setup setup)
    : setup_(std::move(setup)), step_(step_function<Dim>(setup_.order))
{
  connect(std::move(decomposition));
}

template <int Dim>
void UpdatedLagrangian<Dim>::connect(Decomposition<Dim> decomposition)
{
  exchange_ = std::make_unique<Exchange<Dim>>(std::move(decomposition), *setup_.transfer);
  const auto needs =
      node_needs(*setup_.order, setup_.extras, setup_.slots.loads, setup_.slots.need_surfaces());
  int fields = 1;
  for (const Body<Dim>& body : setup_.bodies) fields = std::max(fields, body.field + 1);
  fields_.clear();
  for (int f = 0; f < fields; ++f) fields_.emplace_back(grid().size(), needs, setup_.mass_cut);

  sort_and_activate();
  Step<Dim> step = next_step();
  step.reset();
  const bool with_force = setup_.order->begins_with_force;
  for (Body<Dim>& body : setup_.bodies) {
    step.transfer.prime(body, grid(), step.fields_of(body), with_force);
    step.with_forces(body, 0, {});
  }
  using Fields = NodeFields<Dim>;
  exchange_->halo().sum(step.sums({&Fields::mass_column, with_force ? &Fields::momentum_force_column
                                                                    : &Fields::momentum_column}));
}

template <int Dim>
Step<Dim> UpdatedLagrangian<Dim>::next_step()
{
  return {*exchange_,   *setup_.transfer, setup_.bodies,      fields_,
          setup_.slots, setup_.extras,    {steps_ + 1, time_}};
}

template <int Dim>
void UpdatedLagrangian<Dim>::sort_and_activate()
{
  const std::vector<LocalIndex> left = exchange_->sort(setup_.bodies);
  for (NodeFields<Dim>& field : fields_) field.clear(left);
}

template <int Dim>
void UpdatedLagrangian<Dim>::step(double dt)
{
  Step<Dim> step = next_step();
  step_(step, dt);
  if (exchange_->sort_is_due()) sort_and_activate();
  for (const auto& transport : setup_.slots.transports)
    transport->advance(*exchange_, setup_.bodies, time_, dt);
  time_ += dt;
  ++steps_;
  if (steps_ % Formulation<Dim>::steps_between_checks == 0) check();
}

template <int Dim>
GlobalIndex UpdatedLagrangian<Dim>::repartition(const Ownership<Dim>& ownership)
{
  check();  // what a new exchange knows nothing of
  counters_ = counters();
  Decomposition<Dim> next(decomposition().comm(), ownership);
  const GlobalIndex sent = redistribute(next, setup_.bodies).sent;
  connect(std::move(next));
  return sent;
}

template <int Dim>
void UpdatedLagrangian<Dim>::begin_loading(const Ownership<Dim>& ownership)
{
  counters_ = counters();
  for (Body<Dim>& body : setup_.bodies) {
    std::vector<LocalIndex> all(std::size_t(body.particles.size()));
    std::iota(all.begin(), all.end(), 0);
    body.particles.erase(all);
  }
  connect(Decomposition<Dim>(decomposition().comm(), ownership));
}

template <int Dim>
Carried<Dim> UpdatedLagrangian<Dim>::carried() const
{
  Carried<Dim> carried;
  for (const Body<Dim>& body : bodies()) {
    const ColumnGroup& columns = body.particles.motion();
    const int velocity = columns.find("velocity"), mass = columns.find("mass");
    Lanes kinetic = 0, momentum[Dim];
    for (Lanes& component : momentum) component = 0;
    for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
      const double* motion = columns.block(b);
      const Lanes m = load(motion + mass * lane_count);
      Lanes squared = 0;
      for (int d = 0; d < Dim; ++d) {
        const Lanes v = load(motion + (velocity + d) * lane_count);
        momentum[d] += m * v;
        squared += v * v;
      }
      kinetic += 0.5 * m * squared;
    }
    carried.kinetic_energy += stdx::reduce(kinetic);
    for (int d = 0; d < Dim; ++d) carried.momentum[d] += stdx::reduce(momentum[d]);
  }
  const auto add = [&](const ContactSums& sums) {
    if (!carried.contact) carried.contact = ContactSums{};
    *carried.contact += sums;
  };
  for (const auto& contact : setup_.slots.contacts)
    if (const auto sums = contact->sums()) add(*sums);
  for (const auto& condition : setup_.slots.conditions)
    if (condition->pushes())
      for (const Body<Dim>& body : bodies()) add(condition->stored(body, time_));
  return carried;
}

template <int Dim>
Counters UpdatedLagrangian<Dim>::counters_of_exchange() const
{
  return {exchange_->migrated(), exchange_->messages(), exchange_->bytes_sent(),
          exchange_->waiting_seconds()};
}

template <int Dim>
Counters UpdatedLagrangian<Dim>::counters() const
{
  Counters sum = counters_;
  return sum += counters_of_exchange();
}

template <int Dim>
std::size_t UpdatedLagrangian<Dim>::bytes() const
{
  std::size_t bytes = grid().bytes();
  for (const NodeFields<Dim>& field : fields_) bytes += field.bytes();
  for (const Body<Dim>& body : setup_.bodies) bytes += body.particles.bytes();
  return bytes;
}

template <int Dim>
void UpdatedLagrangian<Dim>::archive(Archive& archive)
{
  archive.value("time", time_);
  archive.value("steps", steps_);
  archive.value("checked", checked_);
  {
    const Archive::Section section(archive, "agreed");
    agreed_.archive(archive);
  }
  {
    const Archive::Section section(archive, "counters");
    // The whole count, of which this exchange's own, in another run, is another share.
    Counters all = counters();
    all.archive(archive);
    if (archive.is_loading()) counters_ = all -= counters_of_exchange();
  }
  if (archive.regroups()) {
    take_own_particles(archive);
    archive.pass_over("exchange");
    for (std::size_t f = 0; f < fields_.size(); ++f) archive.pass_over("field" + std::to_string(f));
    return setup_.slots.archive(archive);
  }
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    const Archive::Section section(archive, "body" + std::to_string(b));
    setup_.bodies[b].particles.archive(archive);
  }
  {
    const Archive::Section section(archive, "exchange");
    exchange_->archive(archive);
  }
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const Archive::Section section(archive, "field" + std::to_string(f));
    fields_[f].archive(archive);
  }
  setup_.slots.archive(archive);
}

/// Those of all ranks that are in this one's cells; then all is as after a repartition.
template <int Dim>
void UpdatedLagrangian<Dim>::take_own_particles(Archive& archive)
{
  const Decomposition<Dim> here = decomposition();
  const auto is_here = [&](std::span<const double> row) {
    const Eigen::Map<const Vec<Dim>> position(row.data());
    return here.owner_of_cell(here.geometry().cell_of(position)) == here.rank();
  };
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    const Archive::Section section(archive, "body" + std::to_string(b));
    setup_.bodies[b].particles.take(archive, archive.rows_where("motion/position", Dim, is_here));
  }
  connect(here);
}

template class UpdatedLagrangian<2>;
template class UpdatedLagrangian<3>;

}  // namespace mpm
