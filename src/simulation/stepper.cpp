#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/stepper.hpp>

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Particles cross a cell in hundreds of steps; sorting costs about as much as a third of a step.
constexpr int steps_between_sorts = 50;
/// Activity is marked one node wide of the particles' stencils: sort before they can leave that.
constexpr double cells_between_sorts = 0.5;

template <int Dim>
MoveBounds<Dim> move_bounds(const Decomposition<Dim>& decomposition)
{
  const GridGeometry<Dim>& geometry = decomposition.geometry();
  const IndexBox<Dim> owned = decomposition.owned(decomposition.rank());
  MoveBounds<Dim> bounds;
  for (int d = 0; d < Dim; ++d) {
    bounds.home_lower[d] = geometry.node_position(d, owned.lower[d]);
    bounds.home_upper[d] = geometry.node_position(d, owned.upper[d]);
    // One cell beyond the owned ones, but never where a stencil would leave the grid.
    bounds.reach_lower[d] = geometry.node_position(d, std::max(1, owned.lower[d] - 1));
    bounds.reach_upper[d] =
        geometry.node_position(d, std::min(geometry.nodes[d] - 2, owned.upper[d] + 1));
  }
  return bounds;
}

}  // namespace

template <int Dim>
Stepper<Dim>::Stepper(const Decomposition<Dim>& decomposition,
                      std::unique_ptr<Transfer<Dim>> transfer, std::vector<Body<Dim>> bodies,
                      std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions,
                      const Setup& setup)
    : decomposition_(decomposition),
      transfer_(std::move(transfer)),
      bodies_(std::move(bodies)),
      conditions_(std::move(conditions)),
      setup_(setup),
      grid_(decomposition.geometry(),
            decomposition.local(decomposition.rank(), transfer_->support()),
            decomposition.owned(decomposition.rank()), setup.mass_cut),
      halo_(decomposition, transfer_->support()),
      migration_(decomposition),
      bounds_(move_bounds(decomposition))
{
  grid_.keep_active(halo_.shared_nodes());
  begin_grid();
}

template <int Dim>
LocalIndex Stepper<Dim>::particles() const
{
  LocalIndex count = 0;
  for (const Body<Dim>& body : bodies_) count += body.particles.size();
  return count;
}

template <int Dim>
void Stepper<Dim>::begin_grid()
{
  const bool with_force = setup_.order != UpdateOrderKind::usf;
  sort_and_activate();
  grid_.reset();
  for (Body<Dim>& body : bodies_) transfer_->prime(body, grid_, with_force);
  if (with_force)
    halo_.sum_mass_momentum_force(grid_);
  else
    halo_.sum_mass_momentum(grid_);
}

template <int Dim>
void Stepper<Dim>::step(double dt)
{
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
  time_ += dt;
  ++steps_;
}

template <int Dim>
void Stepper<Dim>::musl(double dt)
{
  update_grid_velocity(dt);  // v_i = ((mv)_i + dt f_i) / m_i
  grid_.reset_remap();
  for (Body<Dim>& body : bodies_) transfer_->musl_velocity(body, grid_);  // v_p, and back: (mv)_i
  halo_.sum_remapped_momentum(grid_);
  grid_.gradient_from_remap();
  constrain_gradient(dt);

  grid_.reset();
  std::vector<MoveOutcome<Dim>> outcomes;
  for (Body<Dim>& body : bodies_)  // sigma_p, x_p; m_i, (mv)_i, f_i
    outcomes.push_back(transfer_->musl_stress(body, grid_, dt, bounds_));
  halo_.sum_mass_momentum_force(grid_);
  finish_move(outcomes, dt);
}

template <int Dim>
void Stepper<Dim>::usf(double dt)
{
  grid_.gradient_from_momentum();
  constrain_gradient(0);
  for (Body<Dim>& body : bodies_) transfer_->usf_stress(body, grid_, dt);  // sigma_p; f_i
  halo_.sum_force(grid_);
  update_grid_velocity(dt);

  grid_.reset();
  std::vector<MoveOutcome<Dim>> outcomes;
  for (Body<Dim>& body : bodies_)  // v_p, x_p; m_i, (mv)_i
    outcomes.push_back(transfer_->usf_velocity(body, grid_, dt, bounds_));
  halo_.sum_mass_momentum(grid_);
  finish_move(outcomes, dt);
}

template <int Dim>
void Stepper<Dim>::usl(double dt)
{
  update_grid_velocity(dt);
  grid_.gradient_from_updated();

  grid_.reset();
  std::vector<MoveOutcome<Dim>> outcomes;
  for (Body<Dim>& body : bodies_)  // all at once
    outcomes.push_back(transfer_->usl(body, grid_, dt, bounds_));
  halo_.sum_mass_momentum_force(grid_);
  finish_move(outcomes, dt);
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
void Stepper<Dim>::finish_move(std::vector<MoveOutcome<Dim>>& outcomes, double dt)
{
  largest_speed_ = 0;
  bool lost = false;
  std::vector<typename Migration<Dim>::Leavers> leavers;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    largest_speed_ = std::max(largest_speed_, outcomes[b].largest_speed);
    lost = lost || outcomes[b].lost.has_value();
    leavers.push_back({&bodies_[b], outcomes[b].blocks_with_leavers});
  }
  if (lost)  // nothing is sent from a state without meaning
    for (auto& entry : leavers) entry.blocks = {};
  const auto exchanged = migration_.exchange(leavers, lost);
  if (exchanged.failed) stop(outcomes);
  migrated_ += exchanged.sent;

  moved_since_sort_ += largest_speed_ * dt;
  ++steps_since_sort_;
  if (steps_since_sort_ >= steps_between_sorts ||
      moved_since_sort_ > cells_between_sorts * grid_.geometry().smallest_spacing())
    sort_and_activate();
}

template <int Dim>
void Stepper<Dim>::sort_and_activate()
{
  grid_.begin_activity();
  for (Body<Dim>& body : bodies_) {
    ParticleStore& particles = body.particles;
    transfer_->first_nodes(particles, grid_, first_nodes_);
    counts_.assign(std::size_t(grid_.size()) + 1, 0);
    for (const LocalIndex node : first_nodes_) {
      grid_.touch(node);
      ++counts_[node + 1];
    }
    if (std::ranges::is_sorted(first_nodes_)) continue;
    std::partial_sum(counts_.begin(), counts_.end(), counts_.begin());
    order_.resize(first_nodes_.size());
    for (std::size_t p = 0; p < first_nodes_.size(); ++p)
      order_[counts_[first_nodes_[p]]++] = LocalIndex(p);
    particles.permute(order_);
    particles.seal();
  }
  grid_.end_activity(transfer_->support());
  moved_since_sort_ = 0;
  steps_since_sort_ = 0;
}

template <int Dim>
void Stepper<Dim>::stop(const std::vector<MoveOutcome<Dim>>& outcomes)
{
  agree(decomposition_.comm(), [&] {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!outcomes[b].lost) continue;
      const LostParticle<Dim>& lost = *outcomes[b].lost;
      const GridGeometry<Dim>& geometry = grid_.geometry();
      bool outside = false, finite = true;
      for (int d = 0; d < Dim; ++d) {
        finite = finite && std::isfinite(lost.position[d]) && std::isfinite(lost.velocity[d]);
        outside = outside || lost.position[d] < geometry.node_position(d, 1) ||
                  lost.position[d] >= geometry.node_position(d, geometry.nodes[d] - 2);
      }
      const char* what = !finite   ? "is no longer a number"
                         : outside ? "left the grid"
                                   : "moved by more than a cell in one step";
      const char* remedy = !finite || !outside
                               ? "Lower numerics.cfl, or look at the last snapshots."
                               : "Give the grid a wider grid.margin, or lower numerics.cfl.";
      throw NumericalError(
          fmt::format("particle {} of body '{}' {} at ({:.6g}, {:.6g}) m in step {}, t = {:.6g} s, "
                      "with velocity "
                      "({:.4g}, {:.4g}) m/s. {}",
                      lost.id, bodies_[b].name, what, lost.position[0], lost.position[1],
                      steps_ + 1, time_, lost.velocity[0], lost.velocity[1], remedy));
    }
  });
  throw NumericalError("a rank stopped without a reason");  // agree() has thrown before
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace mpm
