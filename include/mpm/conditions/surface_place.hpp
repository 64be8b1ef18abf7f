#pragma once
#include <functional>
#include <vector>

namespace mpm {

/// From the mass that a node feels of a body to where the body's surface lies. Were the gap between
/// two bodies the distance of their centres of mass at the node, less a constant, it would be wrong
/// by a third of a cell, as the surface stands to the node.
class SurfacePlace {
 public:
  /// `weight`: of a node, by the distance of a particle along an axis; `size`: of a location; both
  /// lengths in cells.
  SurfacePlace(const std::function<double(double)>& weight, double size);

  /// Where a flat body that fills the space below ends, seen from the node, in cells: by the mean
  /// place of its mass there, sum w m (x_p - x_i) / sum w m.
  double from_mean(double mean) const;

 private:
  /// Ascending, from the first surface that the node feels to the last, evenly.
  std::vector<double> means_;
  double first_, step_;  ///< cells, of these surfaces
};

}  // namespace mpm
