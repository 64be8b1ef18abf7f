/// Rigid bodies of a total Lagrangian step: nodes that move as they are told.

#include <mpm/lagrangian/total_lagrangian.hpp>

#include <algorithm>
#include <array>

namespace mpm {

/// `cells`: of all rigid bodies in turn. A node that two of them have goes with the first.
template <int Dim>
void TotalLagrangian<Dim>::take_rigid_bodies(std::span<const CellNodes> cells)
{
  rigid_cells_.assign(cells.begin(), cells.end());
  led_.clear();
  if (setup_.rigid.empty()) return;
  std::vector<char> is_led(std::size_t(nodes_->size()), 0);
  for (const RigidCells<Dim>& rigid : setup_.rigid) {
    // Ranks on which a node has none of the body's cells lead it too.
    std::vector<double> has_it(std::size_t(nodes_->size()), 0.0);
    for (const CellNodes& corners : cells.first(rigid.locations.size()))
      for (const LocalIndex node : corners) has_it[std::size_t(node)] = 1;
    cells = cells.subspan(rigid.locations.size());
    halo_->sum(std::array{NodeColumn{has_it.data(), 1, 1}});
    std::vector<LocalIndex>& led = led_.emplace_back();
    for (LocalIndex node = 0; node < nodes_->size(); ++node) {
      if (!(has_it[std::size_t(node)] > 0) || is_led[std::size_t(node)]) continue;
      is_led[std::size_t(node)] = 1;
      led.push_back(node);
    }
  }
  nodes_->set_led(std::move(is_led));
}

/// To nodes without a mass of their own, which start as fast as their body does.
template <int Dim>
void TotalLagrangian<Dim>::give_rigid_mass()
{
  constexpr double heavier = 1e6;
  double heaviest = 0;
  for (const Body<Dim>& body : setup_.bodies) heaviest = std::max(heaviest, body.density);
  if (led_.empty()) return;
  rigid_mass_ =
      heavier * heaviest * setup_.location_size.prod() * (Dim == 2 ? setup_.thickness : 1);
  for (std::size_t k = 0; k < led_.size(); ++k)
    for (const LocalIndex node : led_[k]) {
      if (fields_->mass_of(node) > 0) continue;
      fields_->mass_of(node) = rigid_mass_;
      for (int d = 0; d < Dim; ++d)
        fields_->momentum_column()
            .values[std::size_t(node) * NodeFields<Dim>::record_width + std::size_t(d)] =
            rigid_mass_ * setup_.rigid[k].motion[std::size_t(d)].velocity(0);
    }
}

/// What pressed on a node, and what its mass brought along, the body takes; that mass is none where
/// no other cell has the node.
template <int Dim>
void TotalLagrangian<Dim>::lead_rigid_bodies(double dt)
{
  for (std::size_t k = 0; k < led_.size(); ++k) {
    Vec<Dim> velocity;
    for (int d = 0; d < Dim; ++d) {
      const WallMotion& motion = setup_.rigid[k].motion[std::size_t(d)];
      velocity[d] = (motion.displacement(time_ + dt) - motion.displacement(time_)) / dt;
    }
    for (const LocalIndex node : led_[k]) {
      double* u = fields_->updated_of(node);
      const double mass = fields_->mass_of(node), carried = is_rigid(node) ? 0.0 : mass;
      for (int d = 0; d < Dim; ++d) {
        const double before = u[d] - u[Dim + d];
        const double impulse = carried * (velocity[d] - before) - mass * u[Dim + d];
        u[d] = velocity[d];
        u[Dim + d] = velocity[d] - before;
        if (!nodes_->is_owned(node)) continue;
        given_.impulse[d] += impulse;
        given_.work += impulse * 0.5 * (before + velocity[d]);
      }
    }
  }
}

template void TotalLagrangian<2>::take_rigid_bodies(std::span<const CellNodes>);
template void TotalLagrangian<3>::take_rigid_bodies(std::span<const CellNodes>);
template void TotalLagrangian<2>::give_rigid_mass();
template void TotalLagrangian<3>::give_rigid_mass();
template void TotalLagrangian<2>::lead_rigid_bodies(double);
template void TotalLagrangian<3>::lead_rigid_bodies(double);

}  // namespace mpm
