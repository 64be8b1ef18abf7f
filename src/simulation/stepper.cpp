#include <mpm/core/error.hpp>
#include <mpm/parallel/redistribution.hpp>
#include <mpm/simulation/stepper.hpp>

#include <algorithm>

namespace mpm {

namespace {

template <int Dim>
NodeGrid<Dim> local_grid(const Decomposition<Dim>& decomposition, int support, double mass_cut)
{
  return {decomposition.geometry(), decomposition.local(decomposition.rank(), support),
          owned_nodes(decomposition, support), mass_cut};
}

template <int Dim>
MoveBounds<Dim> move_bounds(const Decomposition<Dim>& decomposition)
{
  const GridGeometry<Dim>& geometry = decomposition.geometry();
  const IndexBox<Dim> owned = decomposition.owned(decomposition.rank());
  MoveBounds<Dim> bounds;
  for (int d = 0; d < Dim; ++d) {
    // One cell beyond the owned ones, but never where a stencil would leave the grid.
    bounds.reach_lower[d] = geometry.node_position(d, std::max(1, owned.lower[d] - 1));
    bounds.reach_upper[d] =
        geometry.node_position(d, std::min(geometry.nodes[d] - 2, owned.upper[d] + 1));
  }
  return bounds;
}

}  // namespace

template <int Dim>
Stepper<Dim>::Stepper(Decomposition<Dim> decomposition, std::unique_ptr<Transfer<Dim>> transfer,
                      std::vector<Body<Dim>> bodies,
                      std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions,
                      const Setup& setup)
    : decomposition_(std::move(decomposition)),
      transfer_(std::move(transfer)),
      bodies_(std::move(bodies)),
      conditions_(std::move(conditions)),
      setup_(setup),
      grid_(local_grid(decomposition_, transfer_->support(), setup.mass_cut)),
      halo_(decomposition_, transfer_->support()),
      migration_(decomposition_, transfer_->support(), halo_.neighbours()),
      bounds_(move_bounds(decomposition_))
{
  connect();
}

template <int Dim>
void Stepper<Dim>::connect()
{
  const int support = transfer_->support();
  grid_.keep_active(halo_.shared_nodes());
  // A stencil may move by one node either way before the next sort.
  near_.assign(grid_.size(), 0);
  for (const LocalIndex node : halo_.shared_nodes()) near_[node] = 1;
  grow<Dim>(near_, grid_.local().count(), support, 1);
  begin_grid();
}

template <int Dim>
GlobalIndex Stepper<Dim>::repartition(const Ownership<Dim>& ownership)
{
  counters_ = counters();
  decomposition_ = Decomposition<Dim>(decomposition_.comm(), ownership);
  const GlobalIndex sent = redistribute(decomposition_, bodies_).sent;
  const int support = transfer_->support();
  grid_ = local_grid(decomposition_, support, setup_.mass_cut);
  halo_ = Halo<Dim>(decomposition_, support);
  migration_ = Migration<Dim>(decomposition_, support, halo_.neighbours());
  bounds_ = move_bounds(decomposition_);
  particle_seconds_.clear();  // others' particles are here now
  measure_anew();
  connect();
  return sent;
}

template <int Dim>
LocalIndex Stepper<Dim>::particles() const
{
  LocalIndex count = 0;
  for (const Body<Dim>& body : bodies_) count += body.particles.size();
  return count;
}

template <int Dim>
typename Stepper<Dim>::Counters Stepper<Dim>::counters() const
{
  Counters sum = counters_;
  sum.messages += halo_.traffic().messages + migration_.messages();
  sum.bytes += halo_.traffic().bytes + migration_.bytes();
  sum.waiting_seconds += halo_.traffic().waiting_seconds;
  return sum;
}

template <int Dim>
void Stepper<Dim>::begin_grid()
{
  const bool with_force = setup_.order != UpdateOrderKind::usf;
  sort_and_activate();
  grid_.reset();
  for (Body<Dim>& body : bodies_) transfer_->prime(body, grid_, with_force);
  halo_.begin(with_force ? NodeSum::mass_momentum_force : NodeSum::mass_momentum, grid_);
  halo_.end(grid_);
}

template <int Dim>
void Stepper<Dim>::step(double dt)
{
  busy_.start();
  switch (setup_.order) {
    case UpdateOrderKind::musl:
      musl(dt);
      break;
    case UpdateOrderKind::usf:
      usf(dt);
      break;
    case UpdateOrderKind::usl:
      usl(dt);
      break;
  }
  busy_.stop();
  time_ += dt;
  ++steps_;
  if (steps_ % steps_between_checks == 0) check();
}

template <int Dim>
void Stepper<Dim>::musl(double dt)
{
  update_grid_velocity(dt);  // v_i = ((mv)_i + dt f_i) / m_i
  grid_.reset_remap();
  pass_and_sum(NodeSum::remapped_momentum, [&](const BodyPart<Dim>& part) {
    transfer_->musl_velocity(part, grid_);  // v_p, and back: (mv)_i
  });
  grid_.gradient_from_remap();
  constrain_gradient(dt);

  grid_.reset();
  move_and_sum(NodeSum::mass_momentum_force, dt, [&](const BodyPart<Dim>& part) {
    return transfer_->musl_stress(part, grid_, dt, bounds_);  // sigma_p, x_p; m_i, (mv)_i, f_i
  });
}

template <int Dim>
void Stepper<Dim>::usf(double dt)
{
  grid_.gradient_from_momentum();
  constrain_gradient(0);
  pass_and_sum(NodeSum::force, [&](const BodyPart<Dim>& part) {
    transfer_->usf_stress(part, grid_, dt);  // sigma_p; f_i
  });
  update_grid_velocity(dt);

  grid_.reset();
  move_and_sum(NodeSum::mass_momentum, dt, [&](const BodyPart<Dim>& part) {
    return transfer_->usf_velocity(part, grid_, dt, bounds_);  // v_p, x_p; m_i, (mv)_i
  });
}

template <int Dim>
void Stepper<Dim>::usl(double dt)
{
  update_grid_velocity(dt);
  grid_.gradient_from_updated();

  grid_.reset();
  move_and_sum(NodeSum::mass_momentum_force, dt, [&](const BodyPart<Dim>& part) {
    return transfer_->usl(part, grid_, dt, bounds_);  // all at once
  });
}

template <int Dim>
void Stepper<Dim>::update_grid_velocity(double dt)
{
  grid_.update_velocity(dt);
  for (const auto& condition : conditions_) condition->constrain_updated(grid_, time_, dt);
}

template <int Dim>
void Stepper<Dim>::constrain_gradient(double dt)
{
  for (const auto& condition : conditions_) condition->constrain_gradient(grid_, time_, dt);
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace mpm
