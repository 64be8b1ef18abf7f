#pragma once
/// A grid whose nodes all have mass and different velocities, and what a condition made of them.

#include "node_grid.hpp"

namespace mpm {

/// 9 nodes per axis with spacing 0.5 m (x), 0.25 m (y), 1 m (z) from the origin; this rank holds
/// 0..7 and owns 0..5 along x. Node i has mass 1 + i / 100 and updated velocity 0.1 i + d, of
/// which 0.01 i - d is the increment of this step.
template <int Dim>
struct MovingNodes {
  NodeGrid<Dim> grid;

  explicit MovingNodes(double mass_cut = 0, bool periodic_along_x = false)
      : grid(geometry(periodic_along_x), box(8), box(6), mass_cut)
  {
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) grid.topology.touch(node);
    grid.end_activity(2);
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) {
      grid.fields.mass_of(node) = 1 + node / 100.0;
      for (int d = 0; d < Dim; ++d) {
        grid.fields.updated_of(node)[d] = velocity(node, d);
        grid.fields.updated_of(node)[Dim + d] = increment(node, d);
        grid.fields.set_gradient_velocity(node, d, velocity(node, d));
      }
    }
  }

  static double velocity(LocalIndex node, int d) { return 0.1 * node + d; }
  static double increment(LocalIndex node, int d) { return 0.01 * node - d; }

  double updated(LocalIndex node, int d) { return grid.fields.updated_of(node)[d]; }
  double gradient(LocalIndex node, int d) { return grid.fields.gradient_velocity_of(node)[d]; }

  IndexVec<Dim> index(LocalIndex node) const
  {
    IndexVec<Dim> at;
    for (int d = 0; d < Dim; ++d)
      at[d] = node / grid.topology.stride(d) % grid.topology.local().count()[d];
    return at;
  }
  double coordinate(LocalIndex node, int axis) const
  {
    return grid.topology.geometry().node_position(axis, index(node)[axis]);
  }

 private:
  static GridGeometry<Dim> geometry(bool periodic_along_x)
  {
    const Vec<3> spacing(0.5, 0.25, 1);
    GridGeometry<Dim> geometry{Vec<Dim>::Zero(), spacing.head<Dim>(), IndexVec<Dim>::Constant(9)};
    geometry.periodic[0] = periodic_along_x;
    return geometry;
  }
  static IndexBox<Dim> box(LocalIndex end_of_x)
  {
    IndexBox<Dim> nodes{IndexVec<Dim>::Zero(), IndexVec<Dim>::Constant(9)};
    nodes.upper[0] = end_of_x;
    return nodes;
  }
};

}  // namespace mpm
