#include <mpm/core/error.hpp>
#include <mpm/stepping/exchange.hpp>

#include <algorithm>
#include <numeric>

namespace mpm {

namespace {

/// Particles cross a cell in hundreds of steps; sorting costs about as much as one step.
constexpr int moves_between_sorts = 50;
/// Activity and nearness are marked one node wide of the particles' stencils, so that particles
/// must not go further than a cell between sorts. The next step may take them twice as far as the
/// last one, and this far even from rest.
constexpr double cells_in_a_step = 0.25;
/// Blocks between two looks after the messages.
constexpr LocalIndex blocks_between_looks = 2048 / lane_count;

template <int Dim>
MoveBounds<Dim> move_bounds(const Decomposition<Dim>& decomposition)
{
  const GridGeometry<Dim>& geometry = decomposition.geometry();
  const IndexBox<Dim> owned = decomposition.owned(decomposition.rank());
  MoveBounds<Dim> bounds;
  for (int d = 0; d < Dim; ++d) {
    // One cell beyond the owned ones, but never where a stencil would leave the grid.
    LocalIndex first = owned.lower[d] - 1, last = owned.upper[d] + 1;
    if (!geometry.periodic[d]) {
      first = std::max(1, first);
      last = std::min(geometry.nodes[d] - 2, last);
    }
    bounds.reach_lower[d] = geometry.node_position(d, first);
    bounds.reach_upper[d] = geometry.node_position(d, last);
  }
  return bounds;
}

}  // namespace

template <int Dim>
Exchange<Dim>::Exchange(Decomposition<Dim> decomposition, const Transfer<Dim>& transfer)
    : decomposition_(std::move(decomposition)),
      transfer_(transfer),
      topology_(decomposition_.geometry(),
                decomposition_.local(decomposition_.rank(), transfer.support()),
                owned_nodes(decomposition_, transfer.support())),
      halo_(decomposition_, transfer.support()),
      migration_(decomposition_, transfer.support(), halo_.neighbours()),
      bounds_(move_bounds(decomposition_))
{
  topology_.keep_active(halo_.shared_nodes());
  // A stencil may move by one node either way before the next sort.
  near_.assign(topology_.size(), 0);
  for (const LocalIndex node : halo_.shared_nodes()) near_[node] = 1;
  grow<Dim>(near_, topology_.local().count(), transfer.support(), 1);
  if (transfer.ends_at_walls()) mark_near_walls();
}

/// A stencil reaches beyond a wall when its first node lies below the lower one, or its last above
/// the upper one; and it may move by one node before the next sort.
template <int Dim>
void Exchange<Dim>::mark_near_walls()
{
  const IndexBox<Dim>& local = topology_.local();
  for (LocalIndex node = 0; node < topology_.size(); ++node)
    for (int d = 0; d < Dim; ++d) {
      const auto& [below, above] = topology_.geometry().walls[std::size_t(d)];
      const LocalIndex at = local.lower[d] + node / topology_.stride(d) % local.count()[d];
      if ((below && at <= *below) || (above && at + transfer_.support() > *above))
        near_[std::size_t(node)] = 1;
    }
}

template <int Dim>
void Exchange<Dim>::visit_near(Bodies& bodies, const PartVisit& visit)
{
  if (loss_) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    visit({bodies[b], 0, orders_[b].near_end}, b);
    visit({bodies[b], orders_[b].rest, bodies[b].particles.blocks()}, b);
  }
}

template <int Dim>
void Exchange<Dim>::visit_interior(Bodies& bodies, const PartVisit& visit)
{
  if (loss_) return;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (LocalIndex first = orders_[b].near_end; first < orders_[b].rest;
         first += blocks_between_looks) {
      constexpr bool is_interior = true;
      const LocalIndex end = std::min(first + blocks_between_looks, orders_[b].rest);
      visit({bodies[b], first, end, is_interior}, b);
      halo_.advance();
    }
}

template <int Dim>
void Exchange<Dim>::pass_and_sum(Bodies& bodies, std::span<const NodeColumn> columns,
                                 const Moment& moment, const Pass& pass)
{
  const auto visit = [&](const BodyPart<Dim>& part, std::size_t) {
    if (const auto lost = pass(part).lost) note_loss(part.body, *lost, moment);
  };
  visit_near(bodies, visit);
  halo_.begin(columns);
  visit_interior(bodies, visit);
  MPM_ASSERT(loss_ || halo_.untouched());
  halo_.end();
}

template <int Dim>
void Exchange<Dim>::move_and_sum(Bodies& bodies, std::span<const NodeColumn> columns,
                                 const Moment& moment, double dt, const MovingPass& pass)
{
  largest_speed_ = 0;
  std::vector<std::optional<LostParticle<Dim>>> lost(bodies.size());
  const auto visit = [&](const BodyPart<Dim>& part, std::size_t body) {
    const PassOutcome<Dim> outcome = pass(part, bounds_);
    largest_speed_ = std::max(largest_speed_, outcome.largest_speed);
    if (outcome.lost && !lost[body]) lost[body] = outcome.lost;
  };
  const auto note_losses = [&] {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (lost[b]) note_loss(bodies[b], *lost[b], moment);
  };
  visit_near(bodies, visit);
  note_losses();  // before leavers are looked for: a lost particle is not where it went
  collect_leavers(bodies, moment);
  halo_.begin(columns, migration_.notes());
  visit_interior(bodies, visit);
  note_losses();
  note_far_moves(bodies, moment, dt);
  MPM_ASSERT(loss_ || halo_.untouched());
  halo_.end();
  exchange_leavers(bodies);

  moved_last_ = largest_speed_ * dt;
  moved_since_sort_ += moved_last_;
  ++moves_since_sort_;
}

template <int Dim>
bool Exchange<Dim>::sort_is_due() const
{
  const double cell = topology_.geometry().smallest_spacing();
  return moves_since_sort_ >= moves_between_sorts ||
         moved_since_sort_ + std::max(2 * moved_last_, cells_in_a_step * cell) > cell;
}

template <int Dim>
void Exchange<Dim>::note_loss(const Body<Dim>& body, const LostParticle<Dim>& lost,
                              const Moment& moment)
{
  if (!loss_) loss_ = Loss<Dim>{lost, body.name, moment};
}

/// Sums of a step in which a particle went further than its last speed announced miss a part of it:
/// the fastest of this rank is named.
template <int Dim>
void Exchange<Dim>::note_far_moves(const Bodies& bodies, const Moment& moment, double dt)
{
  const double allowed = topology_.geometry().smallest_spacing();
  if (loss_ || moved_since_sort_ + largest_speed_ * dt <= allowed) return;
  std::optional<LostParticle<Dim>> fastest;
  const Body<Dim>* its_body = nullptr;
  for (const Body<Dim>& body : bodies)
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      const LostParticle<Dim> particle = lost_particle<Dim>(body.particles, p);
      if (fastest && !(particle.velocity.norm() > fastest->velocity.norm())) continue;
      fastest = particle;
      its_body = &body;
    }
  if (fastest) note_loss(*its_body, *fastest, moment);
}

/// Only particles near other ranks, or near the seam of a periodic axis, can leave.
template <int Dim>
void Exchange<Dim>::collect_leavers(Bodies& bodies, const Moment& moment)
{
  if (halo_.shared_nodes().empty()) return;
  std::vector<std::pair<std::size_t, LocalIndex>> astray;
  visit_near(bodies, [&](const BodyPart<Dim>& part, std::size_t body) {
    if (const auto particle = migration_.collect(part, body)) astray.push_back({body, *particle});
  });
  for (const auto& [body, particle] : astray)
    note_loss(bodies[body], lost_particle<Dim>(bodies[body].particles, particle), moment);
  migration_.send();
}

template <int Dim>
void Exchange<Dim>::exchange_leavers(Bodies& bodies)
{
  if (halo_.shared_nodes().empty()) return;
  const auto outcome = migration_.finish(bodies, halo_.notes());
  migrated_ += outcome.sent;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Order& order = orders_[b];
    // What stays in the interior is interior: gaps are in other blocks, and filled from the end.
    order.rest = std::min(order.rest, outcome.stayed[b] / lane_count);
    order.near_end = std::min(order.near_end, order.rest);
  }
}

template <int Dim>
std::vector<LocalIndex> Exchange<Dim>::sort(Bodies& bodies)
{
  topology_.begin_activity();
  orders_.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) sort_body(b, bodies[b].particles);
  moved_since_sort_ = 0;
  moves_since_sort_ = 0;
  return topology_.end_activity(transfer_.support());
}

/// Those near other ranks and walls first, and both parts by the first node of the stencil.
template <int Dim>
void Exchange<Dim>::sort_body(std::size_t number, ParticleStore& particles)
{
  transfer_.first_nodes(particles, topology_, first_nodes_);
  const LocalIndex nodes = topology_.size();
  counts_.assign(2 * std::size_t(nodes) + 1, 0);
  for (LocalIndex& key : first_nodes_) {
    topology_.touch(key);
    if (!near_[key]) key += nodes;
    ++counts_[key + 1];
  }
  std::partial_sum(counts_.begin(), counts_.end(), counts_.begin());
  orders_[number].near_end = (counts_[nodes] + lane_count - 1) / lane_count;
  orders_[number].rest = std::max(orders_[number].near_end, particles.size() / lane_count);
  if (std::ranges::is_sorted(first_nodes_)) return;
  order_.resize(first_nodes_.size());
  for (std::size_t p = 0; p < first_nodes_.size(); ++p)
    order_[counts_[first_nodes_[p]]++] = LocalIndex(p);
  particles.permute(order_);
  particles.seal();
}

/// Local numbers mean something on the part of the grid only on which they were saved.
template <int Dim>
void Exchange<Dim>::archive_part(Archive& archive) const
{
  const IndexBox<Dim>& local = topology_.local();
  std::vector<std::int64_t> part{decomposition_.rank(), decomposition_.ranks(),
                                 GlobalIndex(halo_.shared_nodes().size()), halo_.sent_nodes()};
  part.insert(part.end(), local.lower.data(), local.lower.data() + Dim);
  part.insert(part.end(), local.upper.data(), local.upper.data() + Dim);
  const std::vector<std::int64_t> here = part;
  archive.values("part", part);
  if (part != here)
    throw InputError(
        "saved state: it belongs to another part of the grid. Load it on as many ranks as it was "
        "saved on, with the same borders between them.");
}

/// A loss that the ranks have not yet agreed on.
template <int Dim>
void Exchange<Dim>::archive_loss(Archive& archive)
{
  const Archive::Section section(archive, "loss");
  int lost = loss_.has_value();
  archive.value("lost", lost);
  if (lost == 0) return loss_.reset();
  Loss<Dim> loss = loss_.value_or(Loss<Dim>{});
  archive.value("id", loss.particle.id);
  archive.values("position", {loss.particle.position.data(), std::size_t(Dim)});
  archive.values("velocity", {loss.particle.velocity.data(), std::size_t(Dim)});
  int fault = int(loss.particle.fault);
  archive.value("fault", fault);
  loss.particle.fault = Fault(fault);
  archive.value("ratio", loss.particle.ratio);
  archive.text("body", loss.body);
  archive.value("step", loss.moment.step);
  archive.value("time", loss.moment.time);
  loss_ = loss;
}

template <int Dim>
void Exchange<Dim>::archive(Archive& archive)
{
  archive_part(archive);
  archive.value("largest_speed", largest_speed_);
  archive.value("moved_since_sort", moved_since_sort_);
  archive.value("moved_last", moved_last_);
  archive.value("moves_since_sort", moves_since_sort_);
  archive_loss(archive);
  for (std::size_t b = 0; b < orders_.size(); ++b) {
    const Archive::Section section(archive, "order" + std::to_string(b));
    archive.value("near_end", orders_[b].near_end);
    archive.value("rest", orders_[b].rest);
  }
  std::vector<std::int64_t> touched;
  for (LocalIndex node = 0; node < topology_.size(); ++node)
    if (topology_.is_touched(node)) touched.push_back(node);
  archive.list("touched", touched);
  if (!archive.is_loading()) return;
  topology_.begin_activity();
  for (const std::int64_t node : touched) topology_.touch(LocalIndex(node));
  topology_.end_activity(transfer_.support());
}

template class Exchange<2>;
template class Exchange<3>;

}  // namespace mpm
