/// Cells that fail: they are removed, and their mass stays on their corners.

#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/parallel/session.hpp>

#include <utility>

namespace mpm {

/// Of this rank. Returns the locations that they had, one behind the other.
template <int Dim>
std::vector<double> TotalLagrangian<Dim>::remove_failed()
{
  std::vector<double> locations;
  for (std::size_t b = 0; b < setup_.failure.size(); ++b) {
    Body<Dim>& body = setup_.bodies[b];
    const std::vector<LocalIndex> found = cells_[b].find_failed(body, setup_.failure[b]);
    if (found.empty()) continue;
    const ParticleStore& particles = body.particles;
    const int mass = particles.motion().find("mass"), work = particles.state().find("plastic_work");
    for (const LocalIndex cell : found) {
      ++failed_.cells;
      failed_.id_sum += particles.ids()[std::size_t(cell)];
      failed_.mass += particles.motion()(mass, cell);
      failed_.energy += cells_[b].stored_energy(body, *nodes_, cell);
      if (work >= 0) failed_.plastic_work += particles.state()(work, cell);
      const IndexVec<Dim> location = location_of_cell(b, cell);
      locations.insert(locations.end(), location.begin(), location.end());
    }
    remove(b, found);
  }
  return locations;
}

/// Ascending ones. Where borders move, what they were at rest goes along.
template <int Dim>
void TotalLagrangian<Dim>::remove(std::size_t body, std::span<const LocalIndex> cells)
{
  for (const LocalIndex cell : cells) removed_.push_back(rest_of(body, cell));
  cells_[body].erase(setup_.bodies[body], cells, least_stretches_[body]);
}

/// Goes on without the cells that were at these locations of this rank, once `remove_failed` was
/// called on every rank. What is behind them now has a surface. Collective.
template <int Dim>
void TotalLagrangian<Dim>::part(std::span<const double> failed_locations)
{
  if (contact_) {
    const std::vector<double> all = joined_over_ranks(decomposition_.comm(), failed_locations);
    for (std::size_t k = 0; k < all.size(); k += Dim) {
      IndexVec<Dim> location;
      for (int d = 0; d < Dim; ++d) location[d] = LocalIndex(all[k + std::size_t(d)]);
      occupants_.remove(location);
    }
  }
  list_what_is_left();
  if (contact_) {
    failed_.energy += contact_->energy();
    renew_pairs();
    failed_.energy -= contact_->energy();
  }
  // Velocities stand half a step before places: half of the next kick is of the time before, and
  // the balance of energy closes to the second order.
  std::vector<double> forces;
  for (LocalIndex node = 0; node < nodes_->size(); ++node)
    for (int d = 0; d < Dim; ++d) forces.push_back(std::exchange(fields_->force_of(node)[d], 0.0));
  const std::vector<double> friction = friction_;
  add_forces(last_step_);
  auto before = forces.begin();
  for (LocalIndex node = 0; node < nodes_->size(); ++node)
    for (int d = 0; d < Dim; ++d) {
      double& force = fields_->force_of(node)[d];
      force = 0.5 * (*before++ + force);
    }
  for (std::size_t k = 0; k < friction.size(); ++k)
    friction_[k] = 0.5 * (friction[k] + friction_[k]);
}

template <int Dim>
void TotalLagrangian<Dim>::list_what_is_left()
{
  if constexpr (Dim == 2) list_node_terms();
  std::vector<char> free(std::size_t(nodes_->size()), 1);
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (LocalIndex p = 0; p < setup_.bodies[b].particles.size(); ++p)
      for (const LocalIndex node : cells_[b].nodes_of(p)) free[std::size_t(node)] = 0;
  for (const std::vector<LocalIndex>& led : led_)
    for (const LocalIndex node : led) free[std::size_t(node)] = 0;
  nodes_->set_free(std::move(free));
  if (contact_) contact_->set_cells(contact_cells(occupants_));
}

template std::vector<double> TotalLagrangian<2>::remove_failed();
template std::vector<double> TotalLagrangian<3>::remove_failed();
template void TotalLagrangian<2>::remove(std::size_t, std::span<const LocalIndex>);
template void TotalLagrangian<3>::remove(std::size_t, std::span<const LocalIndex>);
template void TotalLagrangian<2>::part(std::span<const double>);
template void TotalLagrangian<3>::part(std::span<const double>);

}  // namespace mpm
