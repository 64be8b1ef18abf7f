#pragma once
/// Nodes with one velocity field that has every column.

#include <mpm/grid/node_fields.hpp>

namespace mpm {

template <int Dim>
struct NodeGrid {
  GridTopology<Dim> topology;
  NodeFields<Dim> fields;

  /// `owned`: a box, or marks.
  template <class Owned>
  NodeGrid(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local, const Owned& owned,
           double mass_cut)
      : topology(geometry, local, owned), fields(topology.size(), {true, true}, mass_cut)
  {
  }

  void end_activity(int support) { fields.clear(topology.end_activity(support)); }
};

}  // namespace mpm
