/// Forces on the nodes: of the cells, of contact and of loads.

#include <mpm/lagrangian/total_lagrangian.hpp>

#include <algorithm>
#include <array>

namespace mpm {

template <int Dim>
void TotalLagrangian<Dim>::add_forces(double dt)
{
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    Body<Dim>& body = setup_.bodies[b];
    typename LocationCells<Dim>::Forces forces{};
    if constexpr (Dim == 2)
      forces = cell_forces_.data() + first_force_[b];
    else
      forces = &*fields_;
    const auto inverted = cells_[b].update(body, *nodes_, dt, forces);
    if (!inverted || loss_) continue;
    cells_[b].fill_motion(body, *nodes_, *fields_);
    LostParticle<Dim> lost = lost_particle<Dim>(body.particles, inverted->cell);
    lost.fault = Fault::inverted;
    const double location = setup_.location_size.prod() * (Dim == 2 ? setup_.thickness : 1.0);
    lost.ratio = inverted->jacobian * location / body.particles.state()(0, inverted->cell);
    loss_ = Loss<Dim>{lost, body.name, {steps_, time_ - dt}};
  }
  if constexpr (Dim == 2) gather_cell_forces();
  if (contact_) {
    contact_->measure(*nodes_);
    contact_->add_forces(*fields_);
    if (!friction_.empty()) {
      std::fill(friction_.begin(), friction_.end(), 0.0);
      contact_->add_friction(*fields_, dt, friction_);
    }
  }
  std::vector<NodeColumn> columns{fields_->force_column()};
  if (!friction_.empty()) columns.push_back({friction_.data(), Dim, Dim});
  if (setup_.slots.loads.act_on_particles()) columns.push_back(fields_->load_force_column());
  add_loads_on_particles();
  halo_->sum(columns);
  for (LocalIndex node = 0; node < LocalIndex(friction_.size() / Dim); ++node)
    for (int d = 0; d < Dim; ++d)
      fields_->force_of(node)[d] += friction_[std::size_t(node) * Dim + std::size_t(d)];
}

/// What it took from the bodies in the step that ends.
template <int Dim>
void TotalLagrangian<Dim>::book_friction(double dt)
{
  for (LocalIndex node = 0; node < LocalIndex(friction_.size() / Dim); ++node) {
    if (!nodes_->is_owned(node)) continue;
    const double* u = fields_->updated_of(node);
    for (int d = 0; d < Dim; ++d) {
      const double work =
          dt * friction_[std::size_t(node) * Dim + std::size_t(d)] * (u[d] - 0.5 * u[Dim + d]);
      given_.work += work;
      friction_work_ -= work;
    }
  }
}

/// f_i of the cells at a node, and no load yet.
template <int Dim>
void TotalLagrangian<Dim>::gather_cell_forces()
{
  using Row = Record<Dim>;
  constexpr int corners = LocationMesh<Dim>::corners;
  const double* forces = cell_forces_.data();
  const std::int32_t* term = node_terms_.data();
  for (LocalIndex node = 0; node < nodes_->size(); ++node, term += corners) {
    Row sum(forces + term[0], stdx::vector_aligned);
    for (int c = 1; c < corners; ++c) sum += Row(forces + term[c], stdx::vector_aligned);
    sum.copy_to(fields_->force_of(node), stdx::vector_aligned);
  }
}

namespace {

/// What each corner of a cell bears of a load on it: of one on the surface those of the face that
/// is seen, as the load acts there and not in the middle of the cell.
template <int Dim>
std::array<double, LocationMesh<Dim>::corners> shares_of_corners(const Load<Dim>& load)
{
  constexpr int corners = LocationMesh<Dim>::corners;
  std::array<double, corners> shares;
  shares.fill(1.0 / corners);
  if (const auto mark = load.mark())
    for (int c = 0; c < corners; ++c)
      shares[std::size_t(c)] =
          LocationMesh<Dim>::offset_of(c)[mark->axis] == int(mark->upper) ? 2.0 / corners : 0.0;
  return shares;
}

}  // namespace

/// Of each to the corners of its cell, as a partial sum.
template <int Dim>
void TotalLagrangian<Dim>::add_loads_on_particles()
{
  const Loads<Dim>& loads = setup_.slots.loads;
  std::fill(fields_->load_force.begin(), fields_->load_force.end(), 0.0);
  for (const auto& load : loads.all())
    if (load->acts_on_particles())
      for (std::size_t b = 0; b < bodies().size(); ++b) add_load(*load, b);
}

template <int Dim>
void TotalLagrangian<Dim>::add_load(const Load<Dim>& load, std::size_t b)
{
  constexpr int corners = LocationMesh<Dim>::corners;
  const auto shares = shares_of_corners(load);
  const Body<Dim>& body = bodies()[b];
  for (LocalIndex block = 0; block < body.particles.blocks(); ++block) {
    Lanes force[Dim];
    for (Lanes& component : force) component = 0.0;
    load.add_to_particles(body, block, time_, force);
    const LocalIndex* node = &cells_[b].corner_nodes()[std::size_t(block) * corners * lane_count];
    const int count = std::min<LocalIndex>(lane_count, body.particles.size() - block * lane_count);
    for (int lane = 0; lane < count; ++lane)
      for (int c = 0; c < corners; ++c)
        for (int d = 0; d < Dim; ++d)
          fields_->load_force[std::size_t(node[c * lane_count + lane]) * Dim + std::size_t(d)] +=
              shares[std::size_t(c)] * force[d][lane];
  }
}

template void TotalLagrangian<2>::add_forces(double);
template void TotalLagrangian<3>::add_forces(double);
template void TotalLagrangian<2>::book_friction(double);
template void TotalLagrangian<3>::book_friction(double);
template void TotalLagrangian<2>::add_loads_on_particles();
template void TotalLagrangian<3>::add_loads_on_particles();
template void TotalLagrangian<2>::add_load(const Load<2>&, std::size_t);
template void TotalLagrangian<3>::add_load(const Load<3>&, std::size_t);

}  // namespace mpm
