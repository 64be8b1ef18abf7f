#pragma once
/// The nodes of some cells of a grid, made active on every kind of map of owners.

#include <mpm/parallel/node_vector.hpp>
#include <mpm/parallel/session.hpp>

#include <cmath>
#include <functional>
#include <string>

#include "ragged_blocks.hpp"
#include <gmock/gmock.h>
#include <petscsys.h>

namespace mpm {

inline constexpr int support = 3;

template <int Dim>
using InRegion = std::function<bool(const IndexVec<Dim>& cell)>;

/// Cells of unequal edges, so that axes cannot be taken for one another.
template <int Dim>
GridGeometry<Dim> oblong_grid()
{
  if constexpr (Dim == 2)
    return {{-1.0, 0.5}, {0.25, 0.125}, {26, 22}};
  else
    return {{-1.0, 0.5, 2.0}, {0.25, 0.125, 0.5}, {13, 12, 11}};
}

/// Cuts in two rows where that is possible, METIS's blocks, and blocks without order.
template <int Dim>
std::vector<Ownership<Dim>> maps_of(const GridGeometry<Dim>& geometry)
{
  const int ranks = ranks_of(MPI_COMM_WORLD);
  IndexVec<Dim> wish = IndexVec<Dim>::Constant(1);
  wish[0] = ranks % 2 == 0 ? ranks / 2 : ranks;
  wish[1] = ranks % 2 == 0 ? 2 : 1;
  return {weighted_cuts<Dim>(geometry, ranks, wish, {}, {}), metis_blocks(geometry, ranks),
          scattered_blocks(geometry, 3, ranks, 5)};
}

/// Whether a cell's middle is in a ball, or what becomes of one, in the middle of the grid.
template <int Dim>
bool in_ball(const GridGeometry<Dim>& geometry, const IndexVec<Dim>& cell)
{
  double distance = 0;
  for (int d = 0; d < Dim; ++d)
    distance += std::pow((2.0 * cell[d] + 2) / geometry.nodes[d] - 1, 2);
  return distance < 0.6;
}

/// The nodes of the cells in a region, and what lies beside them.
template <int Dim>
class ActiveNodes {
 public:
  ActiveNodes(const Ownership<Dim>& map, InRegion<Dim> region)
      : region_(std::move(region)),
        decomposition_(MPI_COMM_WORLD, map),
        halo_(decomposition_, support),
        topology_(map.geometry(), map.local(decomposition_.rank(), support),
                  owned_nodes(decomposition_, support)),
        rows_(decomposition_, topology_, halo_, marks())
  {
  }

  const Decomposition<Dim>& decomposition() const { return decomposition_; }
  const GridGeometry<Dim>& geometry() const { return decomposition_.geometry(); }
  const GridTopology<Dim>& topology() const { return topology_; }
  const NodeRows<Dim>& rows() const { return rows_; }

  /// Cells of the region around a node: all of them inside it, none where it is inactive.
  int cells_at(const IndexVec<Dim>& node) const
  {
    int count = 0;
    for_each_index(IndexBox<Dim>{(node.array() - 1).matrix(), (node.array() + 1).matrix()},
                   [&](const IndexVec<Dim>& cell) { count += has(cell); });
    return count;
  }
  bool is_active(const IndexVec<Dim>& node) const { return cells_at(node) > 0; }
  bool is_inside(const IndexVec<Dim>& node) const { return cells_at(node) == 1 << Dim; }
  /// Whether this rank's particles may touch a node: they are in its cells, or in images of others
  /// next to these.
  bool reaches(const IndexVec<Dim>& node) const
  {
    const IndexBox<Dim> around{(node.array() - 3).matrix(), (node.array() + 3).matrix()};
    const IndexBox<Dim> grid{IndexVec<Dim>::Zero(), geometry().nodes};
    bool found = false;
    for_each_index(intersection(around, grid), [&](const IndexVec<Dim>& cell) {
      found = found || decomposition_.owner_of_cell(cell) == decomposition_.rank();
    });
    return found;
  }

  /// visit(cell, rows of its nodes, x fastest) for the region's cells that this rank owns.
  template <class Visit>
  void for_each_cell(Visit visit) const
  {
    for_each_index(decomposition_.owned(decomposition_.rank()), [&](const IndexVec<Dim>& cell) {
      if (!has(cell) || decomposition_.owner_of_cell(cell) != decomposition_.rank()) return;
      std::vector<PetscInt> rows;
      for_each_index(IndexBox<Dim>{cell, (cell.array() + 2).matrix()},
                     [&](const IndexVec<Dim>& node) {
                       rows.push_back(PetscInt(rows_.of(topology_.index_of(node))));
                     });
      visit(cell, rows);
    });
  }

 private:
  bool has(const IndexVec<Dim>& cell) const
  {
    // The last node of an axis bounds no cell, unless the axis begins again.
    bool inside = true;
    for (int d = 0; d < Dim; ++d)
      inside =
          inside && (geometry().periodic[d] || (cell[d] >= 0 && cell[d] < geometry().nodes[d] - 1));
    return inside && region_(geometry().wrapped(cell));
  }
  std::vector<char> marks() const
  {
    std::vector<char> marks;
    for_each_index(topology_.local(),
                   [&](const IndexVec<Dim>& node) { marks.push_back(is_active(node)); });
    return marks;
  }

  InRegion<Dim> region_;
  Decomposition<Dim> decomposition_;
  Halo halo_;
  GridTopology<Dim> topology_;
  NodeRows<Dim> rows_;
};

template <class DimTag>
class OnActiveNodes : public ::testing::Test {
 protected:
  static constexpr int dim = DimTag::value;
  using Active = ActiveNodes<dim>;

  template <class Check>
  static void on_all_maps(const GridGeometry<dim>& geometry, const InRegion<dim>& region,
                          const Check& check)
  {
    int number = 0;
    for (const Ownership<dim>& map : maps_of(geometry)) {
      SCOPED_TRACE("map " + std::to_string(number++));
      check(Active(map, region));
    }
  }
  static InRegion<dim> ball(const GridGeometry<dim>& geometry)
  {
    return [geometry](const IndexVec<dim>& cell) { return in_ball(geometry, cell); };
  }
};

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

}  // namespace mpm
