/// Passes over the particles of a step: those near other ranks first, the rest while messages
/// travel.

#include <mpm/core/error.hpp>
#include <mpm/simulation/stepper.hpp>

#include <algorithm>
#include <numeric>

namespace mpm {

namespace {

/// Particles cross a cell in hundreds of steps; sorting costs about as much as one step.
constexpr int steps_between_sorts = 50;
/// Activity and nearness are marked one node wide of the particles' stencils, so that particles
/// must not go further than a cell between sorts. The next step may take them twice as far as the
/// last one, and this far even from rest.
constexpr double cells_in_a_step = 0.25;
/// Blocks between two looks after the messages.
constexpr LocalIndex blocks_between_looks = 2048 / lane_count;

}  // namespace

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
  const auto note_losses = [&] {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (lost[b]) note_loss(b, *lost[b]);
  };
  visit_near(visit);
  note_losses();  // before leavers are looked for: a lost particle is not where it went
  collect_leavers();
  halo_.begin(sum, grid_, migration_.notes());
  visit_interior(visit);
  note_losses();
  collect_sums();
  exchange_leavers();

  const double moved = largest_speed_ * dt;
  moved_since_sort_ += moved;
  ++steps_since_sort_;
  const double cell = grid_.geometry().smallest_spacing();
  if (steps_since_sort_ >= steps_between_sorts ||
      moved_since_sort_ + std::max(2 * moved, cells_in_a_step * cell) > cell)
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

template void Stepper<2>::pass_and_sum(NodeSum, const std::function<void(const BodyPart<2>&)>&);
template void Stepper<3>::pass_and_sum(NodeSum, const std::function<void(const BodyPart<3>&)>&);
template void Stepper<2>::move_and_sum(NodeSum, double,
                                       const std::function<MoveOutcome<2>(const BodyPart<2>&)>&);
template void Stepper<3>::move_and_sum(NodeSum, double,
                                       const std::function<MoveOutcome<3>(const BodyPart<3>&)>&);
template void Stepper<2>::sort_and_activate();
template void Stepper<3>::sort_and_activate();

}  // namespace mpm
