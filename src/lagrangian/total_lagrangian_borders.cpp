/// Cells on other ranks: what each costs in a step, and how they go where the borders have moved.

#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/parallel/traded_state.hpp>

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace mpm {

namespace {

/// Where corners stand beside the lattice, on their way to another rank with the cells that have
/// them.
template <int Dim>
struct TradedCorners {
  static constexpr int corners_of_cell = LocationMesh<Dim>::corners;
  static constexpr std::size_t values = std::size_t(2 * Dim * corners_of_cell);  ///< of a cell

  static void pack(const CornerOffsets<Dim>& offsets, const IndexVec<Dim>& location,
                   std::vector<double>& list)
  {
    for (int c = 0; c < corners_of_cell; ++c) {
      const IndexVec<Dim> corner = location + LocationMesh<Dim>::offset_of(c);
      for (const Vec<Dim>& each : {offsets(corner), offsets.way(corner)})
        list.insert(list.end(), each.begin(), each.end());
    }
  }
  static void unpack(const double* at, const IndexVec<Dim>& location, CornerOffsets<Dim>& offsets)
  {
    for (int c = 0; c < corners_of_cell; ++c, at += 2 * Dim)
      offsets.add(location + LocationMesh<Dim>::offset_of(c), Eigen::Map<const Vec<Dim>>(at),
                  Eigen::Map<const Vec<Dim>>(at + Dim));
  }
};

}  // namespace

/// In cells: a cell counts 1, wherever its corners are now.
template <int Dim>
void TotalLagrangian<Dim>::visit_work(
    const std::function<void(const IndexVec<Dim>&, double)>& visit) const
{
  const auto add = [&](const IndexVec<Dim>& location, double work) {
    visit(grid_cell_of(location), work);
  };
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (LocalIndex p = 0; p < setup_.bodies[b].particles.size(); ++p)
      add(location_of_cell(b, p), 1);
  if (contact_) contact_->visit_work(add);
}

template <int Dim>
RestCell<Dim> TotalLagrangian<Dim>::rest_of(std::size_t body, LocalIndex cell) const
{
  const ParticleStore& particles = setup_.bodies[body].particles;
  const ColumnGroup& motion = particles.motion();
  return {int(body), particles.ids()[std::size_t(cell)], motion(motion.find("mass"), cell),
          location_of_cell(body, cell)};
}

template <int Dim>
IndexVec<Dim> TotalLagrangian<Dim>::location_of_cell(std::size_t body, LocalIndex cell) const
{
  return nodes_->corner(cells_[body].nodes_of(cell)[0]);
}

/// Of the grid that is shared out.
template <int Dim>
IndexVec<Dim> TotalLagrangian<Dim>::grid_cell_of(const IndexVec<Dim>& location) const
{
  Vec<Dim> centre;
  for (int d = 0; d < Dim; ++d) centre[d] = (location[d] + 0.5) * setup_.location_size[d];
  return decomposition_.geometry().cell_of(centre);
}

/// This rank's cells are those within its new borders, in the order of their ids, on a mesh at
/// rest, those that have failed among them: what the others and the nodes carry is loaded next.
/// Returns how many have left this rank.
template <int Dim>
GlobalIndex TotalLagrangian<Dim>::take_cells(const Ownership<Dim>& ownership)
{
  const MPI_Comm comm = decomposition_.comm();
  decomposition_ = {comm, ownership};
  std::vector<std::vector<double>> out(static_cast<std::size_t>(decomposition_.ranks()));
  GlobalIndex left = 0;
  const auto send = [&](const RestCell<Dim>& cell) {
    const int owner = decomposition_.owner_of_cell(
        decomposition_.geometry().wrapped(grid_cell_of(cell.location)));
    left += owner != decomposition_.rank();
    std::vector<double>& list = out[std::size_t(owner)];
    cell.pack(list);
    if (fitted_) TradedCorners<Dim>::pack(setup_.offsets, cell.location, list);
  };
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    ParticleStore& particles = setup_.bodies[b].particles;
    std::vector<LocalIndex> all(std::size_t(particles.size()));
    std::iota(all.begin(), all.end(), 0);
    for (const LocalIndex p : all) send(rest_of(b, p));
    particles.erase(all);
  }
  for (std::size_t r = 0; r < setup_.rigid.size(); ++r)
    for (const IndexVec<Dim>& location : std::exchange(setup_.rigid[r].locations, {}))
      send({int(cells_.size() + r), -1, 0.0, location});
  for (const RestCell<Dim>& cell : std::exchange(removed_, {})) send(cell);

  std::vector<RestCell<Dim>> taken;
  CornerOffsets<Dim> offsets;
  for (const std::vector<double>& list : traded_over_ranks(comm, out))
    for (std::size_t k = 0; k < list.size(); k += RestCell<Dim>::values) {
      taken.push_back(RestCell<Dim>::unpacked(&list[k]));
      if (!fitted_) continue;
      TradedCorners<Dim>::unpack(&list[k + RestCell<Dim>::values], taken.back().location, offsets);
      k += TradedCorners<Dim>::values;
    }
  offsets.seal();
  setup_.offsets = std::move(offsets);
  std::ranges::sort(taken, std::less<>());
  for (const RestCell<Dim>& cell : taken) {
    if (cell.id < 0) {
      setup_.rigid[std::size_t(cell.body) - cells_.size()].locations.push_back(cell.location);
      continue;
    }
    ParticleStore& particles = setup_.bodies[std::size_t(cell.body)].particles;
    ColumnGroup& motion = particles.motion();
    const LocalIndex p = particles.add(cell.id);
    for (int d = 0; d < Dim; ++d) motion(d, p) = (cell.location[d] + 0.5) * setup_.location_size[d];
    motion(motion.find("mass"), p) = cell.mass;
    LocationCells<Dim>::initialise(motion, p);
  }
  for (Body<Dim>& body : setup_.bodies) body.particles.seal();
  cells_.clear();
  least_stretches_.clear();
  first_masses_.clear();
  make_mesh();
  add_masses();
  return left;
}

template <int Dim>
GlobalIndex TotalLagrangian<Dim>::repartition(const Ownership<Dim>& ownership)
{
  if (decomposition_.ranks() == 1) return 0;
  const Counters before = counters();
  MemoryArchive saved;
  saved.start_saving();
  archive(saved);
  const GlobalIndex left = take_cells(ownership);
  TradedState state(decomposition_.comm(), saved);
  archive(state);
  MPM_ASSERT(state.unread().empty());
  earlier_ = before;
  return left;
}

template <int Dim>
void TotalLagrangian<Dim>::begin_loading(const Ownership<Dim>& ownership)
{
  loss_.reset();
  if (decomposition_.ranks() == 1 || ownership.packed() == decomposition_.ownership().packed())
    return;
  earlier_ = counters();
  take_cells(ownership);
}

template void TotalLagrangian<2>::visit_work(
    const std::function<void(const IndexVec<2>&, double)>&) const;
template void TotalLagrangian<3>::visit_work(
    const std::function<void(const IndexVec<3>&, double)>&) const;
template RestCell<2> TotalLagrangian<2>::rest_of(std::size_t, LocalIndex) const;
template RestCell<3> TotalLagrangian<3>::rest_of(std::size_t, LocalIndex) const;
template IndexVec<2> TotalLagrangian<2>::location_of_cell(std::size_t, LocalIndex) const;
template IndexVec<3> TotalLagrangian<3>::location_of_cell(std::size_t, LocalIndex) const;
template IndexVec<2> TotalLagrangian<2>::grid_cell_of(const IndexVec<2>&) const;
template IndexVec<3> TotalLagrangian<3>::grid_cell_of(const IndexVec<3>&) const;
template GlobalIndex TotalLagrangian<2>::repartition(const Ownership<2>&);
template GlobalIndex TotalLagrangian<3>::repartition(const Ownership<3>&);
template void TotalLagrangian<2>::begin_loading(const Ownership<2>&);
template void TotalLagrangian<3>::begin_loading(const Ownership<3>&);

}  // namespace mpm
