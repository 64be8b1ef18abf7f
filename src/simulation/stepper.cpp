#include <mpm/core/error.hpp>
#include <mpm/parallel/redistribution.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/stepper.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Particles cross a cell in hundreds of steps; sorting costs about as much as a third of a step.
constexpr int steps_between_sorts = 50;
/// Activity and nearness are marked one node wide of the particles' stencils: sort before they can
/// leave that.
constexpr double cells_between_sorts = 0.5;
/// Blocks between two looks after the messages.
constexpr LocalIndex blocks_between_looks = 2048 / lane_count;

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

template <int Dim>
void Stepper<Dim>::visit_near(const PartVisit& visit)
{
  if (loss_) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    visit({bodies_[b], 0, orders_[b].near_end}, b);
    visit({bodies_[b], orders_[b].rest, bodies_[b].particles.blocks()}, b);
  }
}

template <int Dim>
void Stepper<Dim>::visit_interior(const PartVisit& visit)
{
  if (loss_) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (LocalIndex first = orders_[b].near_end; first < orders_[b].rest;
         first += blocks_between_looks) {
      visit({bodies_[b], first, std::min(first + blocks_between_looks, orders_[b].rest)}, b);
      halo_.advance();
    }
}

template <int Dim>
void Stepper<Dim>::collect_sums()
{
  MPM_ASSERT(loss_ || halo_.untouched(grid_));
  busy_.stop();
  halo_.end(grid_);
  busy_.start();
}

template <int Dim>
void Stepper<Dim>::pass_and_sum(NodeSum sum, const std::function<void(const BodyPart<Dim>&)>& pass)
{
  const auto visit = [&](const BodyPart<Dim>& part, std::size_t) { pass(part); };
  visit_near(visit);
  halo_.begin(sum, grid_);
  visit_interior(visit);
  collect_sums();
}

template <int Dim>
void Stepper<Dim>::move_and_sum(NodeSum sum, double dt,
                                const std::function<MoveOutcome<Dim>(const BodyPart<Dim>&)>& pass)
{
  largest_speed_ = 0;
  std::vector<std::optional<LostParticle<Dim>>> lost(bodies_.size());
  const auto visit = [&](const BodyPart<Dim>& part, std::size_t body) {
    const MoveOutcome<Dim> outcome = pass(part);
    largest_speed_ = std::max(largest_speed_, outcome.largest_speed);
    if (outcome.lost && !lost[body]) lost[body] = outcome.lost;
  };
  visit_near(visit);
  collect_leavers();
  halo_.begin(sum, grid_, migration_.notes());
  visit_interior(visit);
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (lost[b]) note_loss(b, *lost[b]);
  collect_sums();
  exchange_leavers();

  moved_since_sort_ += largest_speed_ * dt;
  ++steps_since_sort_;
  if (steps_since_sort_ >= steps_between_sorts ||
      moved_since_sort_ > cells_between_sorts * grid_.geometry().smallest_spacing())
    sort_and_activate();
}

/// Only particles near other ranks can leave.
template <int Dim>
void Stepper<Dim>::collect_leavers()
{
  if (halo_.shared_nodes().empty()) return;
  std::vector<std::pair<std::size_t, LocalIndex>> astray;
  visit_near([&](const BodyPart<Dim>& part, std::size_t body) {
    if (const auto particle = migration_.collect(part, body)) astray.push_back({body, *particle});
  });
  for (const auto& [body, particle] : astray) note_loss(body, strayed(body, particle));
  migration_.send();
}

template <int Dim>
void Stepper<Dim>::exchange_leavers()
{
  if (halo_.shared_nodes().empty()) return;
  const auto outcome = migration_.finish(bodies_, halo_.notes());
  counters_.migrated += outcome.sent;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Order& order = orders_[b];
    // What stays in the interior is interior: gaps are in other blocks, and filled from the end.
    order.rest = std::min(order.rest, outcome.stayed[b] / lane_count);
    order.near_end = std::min(order.near_end, order.rest);
  }
}

template <int Dim>
void Stepper<Dim>::sort_and_activate()
{
  grid_.begin_activity();
  orders_.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) sort(b, near_);
  grid_.end_activity(transfer_->support());
  moved_since_sort_ = 0;
  steps_since_sort_ = 0;
}

/// Those near other ranks first, and both parts by the first node of the stencil.
template <int Dim>
void Stepper<Dim>::sort(std::size_t body, const std::vector<char>& near)
{
  ParticleStore& particles = bodies_[body].particles;
  transfer_->first_nodes(particles, grid_, first_nodes_);
  const LocalIndex nodes = grid_.size();
  counts_.assign(2 * std::size_t(nodes) + 1, 0);
  for (LocalIndex& key : first_nodes_) {
    grid_.touch(key);
    if (!near[key]) key += nodes;
    ++counts_[key + 1];
  }
  std::partial_sum(counts_.begin(), counts_.end(), counts_.begin());
  orders_[body].near_end = (counts_[nodes] + lane_count - 1) / lane_count;
  orders_[body].rest = std::max(orders_[body].near_end, particles.size() / lane_count);
  if (std::ranges::is_sorted(first_nodes_)) return;
  order_.resize(first_nodes_.size());
  for (std::size_t p = 0; p < first_nodes_.size(); ++p)
    order_[counts_[first_nodes_[p]]++] = LocalIndex(p);
  particles.permute(order_);
  particles.seal();
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace mpm
