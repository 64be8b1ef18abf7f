#pragma once
/// The halo of a decomposition with node values that tell who added what, and what must come of
/// them.

#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "node_grid.hpp"
#include <gmock/gmock.h>

namespace mpm {

inline int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}

/// Ranks in two rows, so that four of them meet in a corner; a row where their number is odd. In
/// space eight meet in a corner of 2 x 2 x 2 and of 3 x 2 x 2.
template <int Dim>
IndexVec<Dim> two_rows()
{
  IndexVec<Dim> wish = IndexVec<Dim>::Constant(1);
  wish[0] = ranks() % 2 == 0 ? ranks() / 2 : ranks();
  wish[1] = ranks() % 2 == 0 ? 2 : 1;
  if (Dim == 3 && ranks() >= 8 && ranks() % 4 == 0) {
    wish[0] = ranks() / 4;
    wish[2] = 2;
  }
  return wish;
}

/// A partial sum with a full mantissa: sums in another order would differ in the last bits. Made of
/// integers, so that no fused multiply-add can give it another value at another place.
inline double partial_value(int rank, GlobalIndex node, int slot)
{
  std::uint64_t bits = std::uint64_t(node) * 64 + std::uint64_t(slot) * 8 + std::uint64_t(rank);
  for (int round = 0; round < 3; ++round) {
    bits = (bits + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    bits ^= bits >> 29;
  }
  return std::ldexp(double(bits >> 11), int(bits % 7) - 50);
}

/// The arrays that sums go to, with every slot filled: what a sum does not concern must stay.
template <int Dim>
struct Slots {
  using Fields = NodeFields<Dim>;
  static constexpr int first_remap = Fields::record_width;
  static constexpr int apart = first_remap + Fields::remap_width;  ///< the mass, where it is
  static constexpr int count = apart + !Fields::mass_slot;

  static double& of(NodeGrid<Dim>& grid, LocalIndex node, int slot)
  {
    if (slot < first_remap)
      return grid.fields.momentum_force[std::size_t(node) * Fields::record_width + slot];
    if (slot < apart)
      return grid.fields
          .remapped_momentum[std::size_t(node) * Fields::remap_width + slot - first_remap];
    return grid.fields.mass_of(node);
  }
  static int mass() { return Fields::mass_slot.value_or(apart); }
  static int momentum(int d) { return d; }
  static int force(int d) { return Dim + d; }
  static int remapped(int d) { return first_remap + d; }
};

/// What each of the four sums concerns.
template <int Dim>
struct SumCase {
  const char* name;
  std::vector<NodeColumn> columns;
  std::set<int> slots;
};

template <int Dim>
std::vector<SumCase<Dim>> node_sums(NodeFields<Dim>& fields)
{
  std::set<int> mass{Slots<Dim>::mass()}, momentum, force, remapped;
  for (int d = 0; d < Dim; ++d) {
    momentum.insert(Slots<Dim>::momentum(d));
    force.insert(Slots<Dim>::force(d));
    remapped.insert(Slots<Dim>::remapped(d));
  }
  const auto together = [](std::set<int> a, const std::set<int>& b) {
    a.insert(b.begin(), b.end());
    return a;
  };
  const auto mass_momentum = together(mass, momentum);
  return {{"mass, momentum, force",
           {fields.mass_column(), fields.momentum_force_column()},
           together(mass_momentum, force)},
          {"mass, momentum", {fields.mass_column(), fields.momentum_column()}, mass_momentum},
          {"force", {fields.force_column()}, force},
          {"remapped momentum", {fields.remap_column()}, remapped}};
}

template <int Dim>
GridGeometry<Dim> grid_of(const IndexVec<Dim>& nodes, std::array<bool, Dim> periodic = {})
{
  return {Vec<Dim>::Zero(), Vec<Dim>::Ones(), nodes, periodic};
}

template <int Dim>
class Sharing {
 public:
  Sharing(const IndexVec<Dim>& nodes, const IndexVec<Dim>& wish, int support)
      : Sharing({MPI_COMM_WORLD, grid_of<Dim>(nodes), wish, {}, {}}, support)
  {
  }
  Sharing(const Decomposition<Dim>& decomposition, int support)
      : support_(support),
        decomposition_(decomposition),
        halo_(decomposition_, support),
        grid_(decomposition_.geometry(), decomposition_.local(rank(), support),
              owned_nodes(decomposition_, support), 0)
  {
  }

  int rank() const { return decomposition_.rank(); }
  Halo& halo() { return halo_; }
  NodeGrid<Dim>& grid() { return grid_; }
  const Decomposition<Dim>& decomposition() const { return decomposition_; }

  /// A rank that holds a node, and in which period.
  using Holder = std::pair<int, std::array<LocalIndex, Dim>>;
  /// Ranks with a cell so near that a particle in it, or in one next to it, may touch the node, in
  /// the order of the sum.
  std::set<Holder> holders(const IndexVec<Dim>& node) const
  {
    // Cell i has nodes i and i + 1; wider functions reach one node further to each side.
    const LocalIndex below = support_ == 2 ? 1 : 2, above = support_ == 2 ? 2 : 3;
    const GridGeometry<Dim>& geometry = decomposition_.geometry();
    IndexBox<Dim> around{(node.array() - above).matrix(), (node.array() + below + 1).matrix()};
    for (int d = 0; d < Dim; ++d) {
      if (geometry.periodic[d]) continue;
      around.lower[d] = std::max(around.lower[d], 0);
      around.upper[d] = std::min(around.upper[d], geometry.nodes[d]);
    }
    std::set<Holder> found;
    for_each_index(around, [&](const IndexVec<Dim>& cell) {
      Holder holder{decomposition_.owner_of_cell(cell), {}};
      // Whoever owns an image of the cell sees the node as many periods nearer.
      for (int d = 0; d < Dim; ++d)
        holder.second[d] = geometry.periods_of(node)[d] - geometry.periods_of(cell)[d];
      found.insert(holder);
    });
    return found;
  }
  std::set<int> sharers(const IndexVec<Dim>& node) const
  {
    std::set<int> ranks;
    for (const Holder& holder : holders(node)) ranks.insert(holder.first);
    return ranks;
  }
  /// The node where this rank holds it.
  bool is_held(const IndexVec<Dim>& node) const
  {
    Holder here{rank(), {}};
    for (int d = 0; d < Dim; ++d) here.second[d] = decomposition_.geometry().periods_of(node)[d];
    return holders(node).contains(here);
  }

  /// The serial sum, in the order of the ranks: the same bits, so no tolerance.
  void expect_serial_sums(int round)
  {
    using S = Slots<Dim>;
    for (const SumCase<Dim>& sum : node_sums<Dim>(grid_.fields)) {
      for_each_index(grid_.topology.local(), [&](const IndexVec<Dim>& node) {
        for (int slot = 0; slot < S::count; ++slot)
          S::of(grid_, grid_.topology.index_of(node), slot) =
              partial_value(rank(), number(node) + round, slot);
      });
      halo_.sum(sum.columns);
      int wrong = 0;
      const IndexVec<Dim>& nodes = decomposition_.geometry().nodes;
      for_each_index(grid_.topology.local(), [&](const IndexVec<Dim>& node) {
        const std::set<Holder> together = holders(node);
        const bool held = is_held(node);
        for (int slot = 0; slot < S::count; ++slot) {
          double expected = 0;
          if (sum.slots.contains(slot) && held)
            for (const auto& [sharer, periods] : together) {
              IndexVec<Dim> there = decomposition_.geometry().wrapped(node);
              for (int d = 0; d < Dim; ++d) there[d] += periods[d] * nodes[d];
              expected += partial_value(sharer, number(there) + round, slot);
            }
          else
            expected = partial_value(rank(), number(node) + round, slot);
          wrong += S::of(grid_, grid_.topology.index_of(node), slot) != expected;
        }
      });
      EXPECT_EQ(wrong, 0) << "values of the sum of " << sum.name << " in round " << round;
    }
  }

  void expect_only_shared_nodes_are_exchanged()
  {
    std::vector<LocalIndex> shared;
    std::set<int> neighbours;
    GlobalIndex sent = 0;
    for_each_index(grid_.topology.local(), [&](const IndexVec<Dim>& node) {
      const std::set<Holder> together = holders(node);
      if (together.size() < 2 || !is_held(node)) return;
      shared.push_back(grid_.topology.index_of(node));
      for (const Holder& holder : together) {
        sent += holder.first != rank();
        neighbours.insert(holder.first);
      }
    });
    neighbours.erase(rank());
    std::ranges::sort(shared);
    EXPECT_EQ(halo_.shared_nodes(), shared);
    EXPECT_EQ(halo_.sent_nodes(), sent);
    EXPECT_EQ(halo_.neighbours(), std::vector<int>(neighbours.begin(), neighbours.end()));
  }

 private:
  GlobalIndex number(const IndexVec<Dim>& node) const
  {
    GlobalIndex number = 0;  // another one for every image
    for (int d = Dim; d-- > 0;)
      number = number * (3 * decomposition_.geometry().nodes[d] + 50) + node[d] + 20;
    return number;
  }

  int support_;
  Decomposition<Dim> decomposition_;
  Halo halo_;
  NodeGrid<Dim> grid_;
};

}  // namespace mpm
