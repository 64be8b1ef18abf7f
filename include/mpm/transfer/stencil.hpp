#pragma once
/// Weights of one block of particles on the nodes around them: a tensor product of one-dimensional
/// shape functions.

#include <mpm/grid/node_grid.hpp>

#include <array>

namespace mpm {

template <int Dim, class Shape>
struct Stencil {
  static constexpr int support = Shape::support;

  Lanes weight[Dim][support];
  Lanes gradient[Dim][support];                     ///< 1/m
  Lanes offset[Dim][support];                       ///< x_i - x_p, m; filled by `measure_offsets`
  alignas(lane_alignment) double base[lane_count];  ///< first node, local numbering (whole numbers)

  Stencil(const Lanes (&position)[Dim], const NodeGrid<Dim>& grid, const Shape& shape)
  {
    Lanes node = 0.0;
    for (int d = 0; d < Dim; ++d) {
      // Measured from node 0 of the whole grid: the same bits on any number of ranks.
      const double inverse_h = 1.0 / grid.geometry().spacing[d];
      const Lanes x = (position[d] - grid.geometry().origin[d]) * inverse_h;
      const Lanes first = stdx::floor(x - shape.base_shift());
      shape.weights(x - first, inverse_h, weight[d], gradient[d]);
      node += (first - double(grid.local().lower[d])) * double(grid.stride(d));
      local_[d] = x - first;
    }
    store(node, base);
  }

  /// For the affine schemes.
  void measure_offsets(const NodeGrid<Dim>& grid)
  {
    for (int d = 0; d < Dim; ++d)
      for (int a = 0; a < support; ++a)
        offset[d][a] = (double(a) - local_[d]) * grid.geometry().spacing[d];
  }

  /// Weights w (x_i - x_p) / D with D = sum w (x_i - x_p)^2 per axis, for APIC. For linear
  /// functions they equal the gradients, and are taken as such: D vanishes on grid lines.
  void affine_weights(Lanes (&affine)[Dim][support]) const
  {
    for (int d = 0; d < Dim; ++d) {
      if constexpr (support == 2) {
        for (int a = 0; a < support; ++a) affine[d][a] = gradient[d][a];
      } else {
        Lanes moment = 0.0;
        for (int a = 0; a < support; ++a) moment += weight[d][a] * offset[d][a] * offset[d][a];
        for (int a = 0; a < support; ++a) affine[d][a] = weight[d][a] * offset[d][a] / moment;
      }
    }
  }

 private:
  Lanes local_[Dim];  ///< position from the first node, in cells
};

/// One-dimensional weights spilled to memory, so that one lane's can be read as a scalar.
template <int Dim, int Support>
struct SpilledWeights {
  alignas(lane_alignment) double value[Dim][Support][lane_count];

  explicit SpilledWeights(const Lanes (&lanes)[Dim][Support])
  {
    for (int d = 0; d < Dim; ++d)
      for (int a = 0; a < Support; ++a) store(lanes[d][a], value[d][a]);
  }
  double operator()(int axis, int node, int lane) const { return value[axis][node][lane]; }
};

}  // namespace mpm
