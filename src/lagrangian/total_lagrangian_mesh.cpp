/// What a total Lagrangian step sets up once: nodes and what they share, masses, lists of terms.

#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/parallel/session.hpp>

#include <array>
#include <cmath>
#include <map>

namespace mpm {

namespace {

using LocationKey = std::array<LocalIndex, 2>;

LocationKey key_of(const IndexVec<2>& location)
{
  return {location[0], location[1]};
}

}  // namespace

/// Of a particle at the centre of its location.
IndexVec<2> TotalLagrangian::location_of(const Body<2>& body, LocalIndex particle) const
{
  IndexVec<2> location;
  for (int d = 0; d < 2; ++d)
    location[d] =
        LocalIndex(std::floor(body.particles.motion()(d, particle) / setup_.location_size[d]));
  return location;
}

/// In locations; 0 for axes without.
IndexVec<2> TotalLagrangian::period() const
{
  const GridGeometry<2>& geometry = decomposition_.geometry();
  IndexVec<2> period = IndexVec<2>::Zero();
  for (int d = 0; d < 2; ++d)
    if (geometry.periodic[d])
      period[d] = LocalIndex(
          std::lround(geometry.nodes[d] * geometry.spacing[d] / setup_.location_size[d]));
  return period;
}

void TotalLagrangian::make_mesh()
{
  const GridGeometry<2>& geometry = decomposition_.geometry();
  const int me = decomposition_.rank();
  const IndexVec<2> period = this->period();
  const auto owner_of = [&](const IndexVec<2>& location) {
    Vec<2> centre;
    for (int d = 0; d < 2; ++d) centre[d] = (location[d] + 0.5) * setup_.location_size[d];
    const IndexVec<2> cell = geometry.wrapped(geometry.cell_of(centre));
    for (int d = 0; d < 2; ++d)
      if (cell[d] < 0 || cell[d] >= geometry.nodes[d]) return me;
    return decomposition_.owner_of_cell(cell);
  };

  // Locations of this rank, and those of others within two of a border between ranks.
  std::vector<IndexVec<2>> cells;
  std::map<LocationKey, int> taken;
  std::vector<double> at_borders;
  for (const Body<2>& body : setup_.bodies)
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      const IndexVec<2> location = location_of(body, p);
      cells.push_back(location);
      taken[key_of(location)] = me;
      bool at_border = false;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i)
          at_border = at_border || owner_of(location + IndexVec<2>(i, j)) != me;
      if (at_border)
        at_borders.insert(at_borders.end(), {double(location[0]), double(location[1])});
    }
  const MPI_Comm comm = decomposition_.comm();
  const std::vector<double> all = joined_over_ranks(comm, at_borders);
  for (std::size_t k = 0; k < all.size(); k += 2) {
    const IndexVec<2> location(LocalIndex(all[k]), LocalIndex(all[k + 1]));
    taken.try_emplace(key_of(location), owner_of(location));
  }
  const std::function<int(const IndexVec<2>&)> rank_of = [&](const IndexVec<2>& location) {
    const auto found = taken.find(key_of(location));
    return found == taken.end() ? -1 : found->second;
  };

  LocationMesh<2> mesh = make_location_mesh<2>(cells, me, rank_of, period);
  nodes_.emplace(std::move(mesh.nodes), std::move(mesh.owned), setup_.location_size, period);
  run_ = nodes_->run();
  fields_.emplace(nodes_->size(), mesh_needs<2>(!setup_.slots.loads.empty()), 0.0);
  halo_.emplace(comm, std::move(mesh.shared));
  std::size_t first = 0;
  for (const Body<2>& body : setup_.bodies) {
    const auto count = std::size_t(body.particles.size());
    cells_.emplace_back(body, std::span(mesh.cells).subspan(first, count), setup_.location_size);
    first += count;
  }
  list_node_terms();
  if (setup_.contact_stiffness > 0) make_contact(mesh.cells, rank_of);
  if (contact_ && setup_.friction > 0) friction_.assign(2 * std::size_t(nodes_->size()), 0.0);
}

void TotalLagrangian::make_contact(const std::vector<LocationCells::CellNodes>& cells,
                                   const std::function<int(const IndexVec<2>&)>& rank_of)
{
  const IndexVec<2> period = this->period();
  const auto is_taken = [&](IndexVec<2> location) {
    for (int d = 0; d < 2; ++d)
      if (period[d] > 0) location[d] = (location[d] + period[d]) % period[d];
    return rank_of(location) >= 0;
  };
  /// Bit k: nothing on one side at least of the diagonal neighbour towards corner k.
  const auto open_corners = [&](const IndexVec<2>& location) {
    unsigned open = 0;
    for (int corner = 0; corner < 4; ++corner)
      if (!is_taken(location + IndexVec<2>(corner & 1 ? 1 : -1, 0)) ||
          !is_taken(location + IndexVec<2>(0, corner & 2 ? 1 : -1)))
        open |= 1u << corner;
    return open;
  };
  std::vector<OverlapContact::Cell> near;
  std::size_t number = 0;
  for (const Body<2>& body : setup_.bodies) {
    const double wave = body.law->wave_speed();
    const double stiffness =
        setup_.contact_stiffness * body.density * wave * wave * setup_.thickness;
    for (LocalIndex p = 0; p < body.particles.size(); ++p, ++number) {
      const IndexVec<2> location = location_of(body, p);
      if (!near_surface<2>(location, is_taken)) continue;
      const auto& n = cells[number];
      near.push_back({{n[0], n[1], n[3], n[2]}, location, stiffness, open_corners(location)});
    }
  }
  contact_.emplace(decomposition_.comm(), std::move(near), setup_.location_size, period);
}

void TotalLagrangian::list_node_terms()
{
  constexpr int corners = LocationMesh<2>::corners;
  std::size_t values = 0;
  for (const Body<2>& body : setup_.bodies) {
    first_force_.push_back(values);
    values += std::size_t(body.particles.blocks()) * LocationCells::block_values;
  }
  cell_forces_.assign(values + 2 * lane_count, 0.0);
  const auto groups = std::size_t((nodes_->size() + lane_count - 1) / lane_count);
  node_terms_.assign(groups * corners * lane_count, std::int32_t(values));
  std::vector<int> filled(std::size_t(nodes_->size()), 0);
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (LocalIndex p = 0; p < setup_.bodies[b].particles.size(); ++p)
      for (int c = 0; c < corners; ++c) {
        const std::size_t block = std::size_t(p / lane_count), lane = std::size_t(p % lane_count);
        const auto node = std::size_t(
            cells_[b].corner_nodes()[(block * corners + std::size_t(c)) * lane_count + lane]);
        const auto slot = std::size_t(filled[node]++);
        node_terms_[(node / lane_count * corners + slot) * lane_count + node % lane_count] =
            std::int32_t(first_force_[b] + block * LocationCells::block_values +
                         2 * std::size_t(c) * lane_count + lane);
      }
}

/// A quarter of a cell's mass and momentum to each of its corners.
void TotalLagrangian::add_masses()
{
  constexpr int corners = LocationMesh<2>::corners;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const ParticleStore& particles = setup_.bodies[b].particles;
    const ColumnGroup& motion = particles.motion();
    const int velocity = motion.find("velocity"), mass = motion.find("mass");
    for (LocalIndex p = 0; p < particles.size(); ++p)
      for (int c = 0; c < corners; ++c) {
        const LocalIndex node =
            cells_[b].corner_nodes()[(std::size_t(p / lane_count) * corners + std::size_t(c)) *
                                         lane_count +
                                     std::size_t(p % lane_count)];
        const double share = motion(mass, p) / corners;
        fields_->mass_of(node) += share;
        for (int d = 0; d < 2; ++d)
          fields_->momentum_column()
              .values[std::size_t(node) * NodeFields<2>::record_width + std::size_t(d)] +=
              share * motion(velocity + d, p);
      }
  }
  halo_->sum(std::array{fields_->mass_column(), fields_->momentum_column()});
  first_masses_.assign(fields_->mass.begin(), fields_->mass.end());
  for (LocalIndex node = 0; node < nodes_->size(); ++node)
    for (int d = 0; d < 2; ++d)
      fields_->updated_of(node)[d] =
          fields_
              ->momentum_force[std::size_t(node) * NodeFields<2>::record_width + std::size_t(d)] /
          fields_->mass_of(node);
}

}  // namespace mpm
