/// What a total Lagrangian step sets up once: nodes and what they share, masses, lists of terms.

#include <mpm/core/index_box.hpp>
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/parallel/session.hpp>

#include <array>
#include <cmath>

namespace mpm {

/// Of a particle at the centre of its location.
template <int Dim>
IndexVec<Dim> TotalLagrangian<Dim>::location_of(const Body<Dim>& body, LocalIndex particle) const
{
  IndexVec<Dim> location;
  for (int d = 0; d < Dim; ++d)
    location[d] =
        LocalIndex(std::floor(body.particles.motion()(d, particle) / setup_.location_size[d]));
  return location;
}

/// In locations; 0 for axes without.
template <int Dim>
IndexVec<Dim> TotalLagrangian<Dim>::period() const
{
  const GridGeometry<Dim>& geometry = decomposition_.geometry();
  IndexVec<Dim> period = IndexVec<Dim>::Zero();
  for (int d = 0; d < Dim; ++d)
    if (geometry.periodic[d])
      period[d] = LocalIndex(
          std::lround(geometry.nodes[d] * geometry.spacing[d] / setup_.location_size[d]));
  return period;
}

template <int Dim>
void TotalLagrangian<Dim>::make_mesh()
{
  const GridGeometry<Dim>& geometry = decomposition_.geometry();
  const int me = decomposition_.rank();
  const IndexVec<Dim> period = this->period();
  const auto cell_of = [&](const IndexVec<Dim>& location) { return grid_cell_of(location); };
  const auto owner_of = [&](const IndexVec<Dim>& any_cell) {
    const IndexVec<Dim> cell = geometry.wrapped(any_cell);
    for (int d = 0; d < Dim; ++d)
      if (cell[d] < 0 || cell[d] >= geometry.nodes[d]) return me;
    return decomposition_.owner_of_cell(cell);
  };

  // Locations of this rank, and those of others within two of a border between ranks.
  std::vector<IndexVec<Dim>> cells;
  std::vector<Occupant> occupants;
  std::vector<double> at_borders;
  const auto add = [&](const IndexVec<Dim>& location, int body) {
    cells.push_back(location);
    occupants.push_back({me, body});
    bool at_border = false;
    const IndexVec<Dim> below = (location.array() - 2).matrix(),
                        above = (location.array() + 2).matrix();
    for_each_index(
        IndexBox<Dim>{cell_of(below), (cell_of(above).array() + 1).matrix()},
        [&](const IndexVec<Dim>& cell) { at_border = at_border || owner_of(cell) != me; });
    if (!at_border) return;
    at_borders.insert(at_borders.end(), location.begin(), location.end());
    at_borders.push_back(body);
  };
  int number = 0;
  for (const Body<Dim>& body : setup_.bodies) {
    for (LocalIndex p = 0; p < body.particles.size(); ++p) add(location_of(body, p), number);
    ++number;
  }
  for (const RigidCells<Dim>& rigid : setup_.rigid) {
    for (const IndexVec<Dim>& location : rigid.locations) add(location, number);
    ++number;
  }
  const MPI_Comm comm = decomposition_.comm();
  const std::vector<double> all = joined_over_ranks(comm, at_borders);
  std::vector<IndexVec<Dim>> known = cells;
  for (std::size_t k = 0; k < all.size(); k += Dim + 1) {
    IndexVec<Dim>& location = known.emplace_back();
    for (int d = 0; d < Dim; ++d) location[d] = LocalIndex(all[k + std::size_t(d)]);
    occupants.push_back({owner_of(cell_of(location)), int(all[k + Dim])});
  }
  Occupants<Dim> taken(box_around<Dim>(known));
  for (std::size_t k = 0; k < known.size(); ++k) taken.put(known[k], occupants[k]);
  const OccupantOf<Dim> occupant_of = [&](const IndexVec<Dim>& location) {
    return taken(location);
  };

  LocationMesh<Dim> mesh = make_location_mesh<Dim>(cells, me, occupant_of, setup_.pairs, period);
  nodes_.emplace(std::move(mesh.nodes), std::move(mesh.owned), setup_.location_size, period,
                 setup_.offsets);
  if (setup_.pairs.any_apart()) nodes_->set_kinds(std::move(mesh.first_bodies));
  run_ = nodes_->run();
  fields_.emplace(nodes_->size(), mesh_needs<Dim>(!setup_.slots.loads.empty()), 0.0);
  halo_.emplace(comm, std::move(mesh.shared));
  std::size_t first = 0;
  for (const Body<Dim>& body : setup_.bodies) {
    const auto count = std::size_t(body.particles.size());
    cells_.emplace_back(body, std::span(mesh.cells).subspan(first, count), setup_.location_size);
    least_stretches_.emplace_back(std::size_t(body.particles.blocks()) * lane_count);
    first += count;
  }
  take_rigid_bodies(std::span(mesh.cells).subspan(first));
  if (fitted_) take_rest();
  if constexpr (Dim == 2) list_node_terms();
  if (setup_.contact_stiffness > 0)
    contact_ =
        std::make_unique<OverlapContact<Dim>>(comm, contact_cells(taken), setup_.contact_stiffness,
                                              setup_.pairs, setup_.location_size, period);
  const bool surfaces_change = contact_ && cells_may_fail();
  if (surfaces_change) occupants_ = std::move(taken);
  // Cells that go to another rank are at rest there first.
  CornerOffsets<Dim> kept;
  if (fitted_ && (surfaces_change || decomposition_.ranks() > 1)) {
    kept.reserve(std::size_t(nodes_->size()));
    for (LocalIndex node = 0; node < nodes_->size(); ++node) {
      const IndexVec<Dim>& corner = nodes_->corner(node);
      kept.add(corner, setup_.offsets(corner), setup_.offsets.way(corner));
    }
    kept.seal();
  }
  setup_.offsets = std::move(kept);
  if (contact_ && setup_.pairs.any_friction())
    friction_.assign(Dim * std::size_t(nodes_->size()), 0.0);
}

template <int Dim>
void TotalLagrangian<Dim>::list_node_terms()
{
  constexpr int corners = LocationMesh<Dim>::corners;
  std::size_t values = 0;
  first_force_.clear();
  for (const Body<Dim>& body : setup_.bodies) {
    first_force_.push_back(values);
    values += std::size_t(body.particles.blocks()) * LocationCells<Dim>::block_values;
  }
  cell_forces_.assign(values + Dim, 0.0);
  node_terms_.assign(std::size_t(nodes_->size()) * corners, std::int32_t(values));
  std::vector<int> filled(std::size_t(nodes_->size()), 0);
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (LocalIndex p = 0; p < setup_.bodies[b].particles.size(); ++p) {
      const auto nodes = cells_[b].nodes_of(p);
      for (int c = 0; c < corners; ++c) {
        const auto node = std::size_t(nodes[std::size_t(c)]);
        node_terms_[node * corners + std::size_t(filled[node]++)] =
            std::int32_t(first_force_[b] + LocationCells<Dim>::force_at(p, c));
      }
    }
}

/// Cells are at rest where their corners stand.
template <int Dim>
void TotalLagrangian<Dim>::take_rest()
{
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    cells_[b].take_rest(setup_.bodies[b], *nodes_, setup_.thickness);
    if (cells_may_fail() && setup_.failure[b].limit_stretch())
      cells_[b].keep_rest(setup_.bodies[b]);
  }
  checked_ = -1;  // the first step has to know them
}

/// An equal part of a cell's mass and momentum to each of its corners.
template <int Dim>
void TotalLagrangian<Dim>::add_masses()
{
  constexpr int corners = LocationMesh<Dim>::corners;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const ParticleStore& particles = setup_.bodies[b].particles;
    const ColumnGroup& motion = particles.motion();
    const int velocity = motion.find("velocity"), mass = motion.find("mass");
    for (LocalIndex p = 0; p < particles.size(); ++p)
      for (const LocalIndex node : cells_[b].nodes_of(p)) {
        const double share = motion(mass, p) / corners;
        fields_->mass_of(node) += share;
        for (int d = 0; d < Dim; ++d)
          fields_->momentum_column()
              .values[std::size_t(node) * NodeFields<Dim>::record_width + std::size_t(d)] +=
              share * motion(velocity + d, p);
      }
  }
  halo_->sum(std::array{fields_->mass_column(), fields_->momentum_column()});
  for (LocalIndex node = 0; node < nodes_->size(); ++node)
    first_masses_.push_back(fields_->mass_of(node));
  // What mass scaling adds has no weight, nor has what stands for a rigid body.
  fields_->loaded_mass = first_masses_;
  give_rigid_mass();
  for (LocalIndex node = 0; node < nodes_->size(); ++node)
    for (int d = 0; d < Dim; ++d)
      fields_->updated_of(node)[d] =
          fields_
              ->momentum_force[std::size_t(node) * NodeFields<Dim>::record_width + std::size_t(d)] /
          fields_->mass_of(node);
}

template void TotalLagrangian<2>::make_mesh();
template void TotalLagrangian<3>::make_mesh();
template void TotalLagrangian<2>::list_node_terms();
template void TotalLagrangian<2>::add_masses();
template void TotalLagrangian<3>::add_masses();
template IndexVec<2> TotalLagrangian<2>::location_of(const Body<2>&, LocalIndex) const;
template IndexVec<2> TotalLagrangian<2>::period() const;
template IndexVec<3> TotalLagrangian<3>::location_of(const Body<3>&, LocalIndex) const;
template IndexVec<3> TotalLagrangian<3>::period() const;

}  // namespace mpm
