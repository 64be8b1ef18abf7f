#pragma once
/// The regular background grid of the whole run.

#include <mpm/core/index_box.hpp>

#include <array>
#include <optional>

namespace mpm {

/// A periodic axis has as many nodes as cells: the cell behind the last node ends at node 0, and
/// node i + nodes is node i again, one period further (an image of it).
template <int Dim>
struct GridGeometry {
  Vec<Dim> origin;                      ///< m, of node 0
  Vec<Dim> spacing;                     ///< m, each axis its own
  IndexVec<Dim> nodes;                  ///< per axis
  std::array<bool, Dim> periodic = {};  ///< axes on which the grid begins again where it ends
  /// Nodes on which a wall at rest stands, at the lower and the upper end of an axis: what moves
  /// lies between them.
  std::array<std::array<std::optional<LocalIndex>, 2>, Dim> walls = {};

  double smallest_spacing() const { return spacing.minCoeff(); }
  double node_position(int axis, LocalIndex index) const
  {
    return origin[axis] + spacing[axis] * index;
  }
  /// m; of a periodic axis.
  double period(int axis) const { return spacing[axis] * nodes[axis]; }
  /// Cell that holds a position; floor((x - origin) / h).
  IndexVec<Dim> cell_of(const Vec<Dim>& position) const;
  /// How many periods an index lies away from the grid itself: 0 on axes that are not periodic.
  IndexVec<Dim> periods_of(const IndexVec<Dim>& index) const;
  /// The node or cell of the grid that an index is an image of.
  IndexVec<Dim> wrapped(const IndexVec<Dim>& index) const
  {
    return index - periods_of(index).cwiseProduct(nodes);
  }
};

}  // namespace mpm
