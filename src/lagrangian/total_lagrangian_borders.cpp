/// Cells on other ranks: what each costs in a step, and how they go where the borders have moved.

#include <mpm/core/error.hpp>
#include <mpm/core/index_order.hpp>
#include <mpm/core/memory_archive.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/parallel/traded_state.hpp>

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

namespace mpm {

namespace {

/// What goes ahead of a cell's state: body (rigid ones after the others), id, mass, and its
/// location.
template <int Dim>
struct Mover {
  int body;
  GlobalIndex id;  ///< of a rigid cell -1
  double mass;
  IndexVec<Dim> location;

  static constexpr std::size_t values = 3 + Dim;
  void pack(std::vector<double>& list) const
  {
    list.insert(list.end(), {double(body), std::bit_cast<double>(id), mass});
    list.insert(list.end(), location.begin(), location.end());
  }
  static Mover unpacked(const double* at)
  {
    Mover mover{int(at[0]), std::bit_cast<GlobalIndex>(at[1]), at[2], {}};
    for (int d = 0; d < Dim; ++d) mover.location[d] = LocalIndex(at[3 + d]);
    return mover;
  }
  /// By id; rigid cells, which have none, as a lattice is gone through.
  bool operator<(const Mover& other) const
  {
    return id == other.id ? stands_before<Dim>(location, other.location) : id < other.id;
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
/// rest: what they and the nodes carry is loaded next. Returns how many have left this rank.
template <int Dim>
GlobalIndex TotalLagrangian<Dim>::take_cells(const Ownership<Dim>& ownership)
{
  const MPI_Comm comm = decomposition_.comm();
  decomposition_ = {comm, ownership};
  std::vector<std::vector<double>> out(static_cast<std::size_t>(decomposition_.ranks()));
  GlobalIndex left = 0;
  const auto send = [&](const Mover<Dim>& mover) {
    const IndexVec<Dim> cell = decomposition_.geometry().wrapped(grid_cell_of(mover.location));
    const int owner = decomposition_.owner_of_cell(cell);
    left += owner != decomposition_.rank();
    mover.pack(out[std::size_t(owner)]);
  };
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    ParticleStore& particles = setup_.bodies[b].particles;
    const int mass = particles.motion().find("mass");
    std::vector<LocalIndex> all;
    for (LocalIndex p = 0; p < particles.size(); ++p) {
      send({int(b), particles.ids()[std::size_t(p)], particles.motion()(mass, p),
            location_of_cell(b, p)});
      all.push_back(p);
    }
    particles.erase(all);
  }
  for (std::size_t r = 0; r < setup_.rigid.size(); ++r)
    for (const IndexVec<Dim>& location : std::exchange(setup_.rigid[r].locations, {}))
      send({int(cells_.size() + r), -1, 0.0, location});
  std::vector<Mover<Dim>> movers;
  for (const std::vector<double>& list : traded_over_ranks(comm, out))
    for (std::size_t k = 0; k < list.size(); k += Mover<Dim>::values)
      movers.push_back(Mover<Dim>::unpacked(&list[k]));
  std::ranges::sort(movers, std::less<>());
  for (const Mover<Dim>& mover : movers) {
    if (mover.id < 0) {
      setup_.rigid[std::size_t(mover.body) - cells_.size()].locations.push_back(mover.location);
      continue;
    }
    ParticleStore& particles = setup_.bodies[std::size_t(mover.body)].particles;
    ColumnGroup& motion = particles.motion();
    const LocalIndex p = particles.add(mover.id);
    for (int d = 0; d < Dim; ++d)
      motion(d, p) = (mover.location[d] + 0.5) * setup_.location_size[d];
    motion(motion.find("mass"), p) = mover.mass;
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
  if (ownership.packed() == decomposition_.ownership().packed()) return;
  earlier_ = counters();
  take_cells(ownership);
}

template void TotalLagrangian<2>::visit_work(
    const std::function<void(const IndexVec<2>&, double)>&) const;
template void TotalLagrangian<3>::visit_work(
    const std::function<void(const IndexVec<3>&, double)>&) const;
template IndexVec<2> TotalLagrangian<2>::location_of_cell(std::size_t, LocalIndex) const;
template IndexVec<3> TotalLagrangian<3>::location_of_cell(std::size_t, LocalIndex) const;
template IndexVec<2> TotalLagrangian<2>::grid_cell_of(const IndexVec<2>&) const;
template IndexVec<3> TotalLagrangian<3>::grid_cell_of(const IndexVec<3>&) const;
template GlobalIndex TotalLagrangian<2>::repartition(const Ownership<2>&);
template GlobalIndex TotalLagrangian<3>::repartition(const Ownership<3>&);
template void TotalLagrangian<2>::begin_loading(const Ownership<2>&);
template void TotalLagrangian<3>::begin_loading(const Ownership<3>&);

}  // namespace mpm
