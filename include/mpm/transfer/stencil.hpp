#pragma once
/// Weights of one block of particles on the nodes around them: a tensor product of one-dimensional
/// shape functions.

#include <mpm/core/lanes.hpp>
#include <mpm/grid/grid_topology.hpp>

#include <algorithm>

namespace mpm {

/// What a stencil needs of the grid, as plain numbers that a pass keeps at hand.
template <int Dim>
struct GridFrame {
  double origin[Dim], spacing[Dim], inverse_spacing[Dim];  ///< m, m, 1/m
  double gradient_scale[Dim];                              ///< 1/m
  double lower[Dim], stride[Dim];                          ///< of the local node numbering

  /// Turns the sign of gradients: the minus of f = - sum V0 tau g costs nothing there.
  GridFrame with_negative_gradients() const
  {
    GridFrame frame = *this;
    for (double& scale : frame.gradient_scale) scale = -scale;
    return frame;
  }

  explicit GridFrame(const GridTopology<Dim>& grid)
  {
    for (int d = 0; d < Dim; ++d) {
      origin[d] = grid.geometry().origin[d];
      spacing[d] = grid.geometry().spacing[d];
      inverse_spacing[d] = 1.0 / spacing[d];
      gradient_scale[d] = inverse_spacing[d];
      lower[d] = grid.local().lower[d];
      stride[d] = grid.stride(d);
    }
  }
};

/// Kept in memory, one column of lanes per value: the kernels read the weights of one particle
/// after the other as scalars.
template <int Dim, class Shape>
struct Stencil {
  static constexpr int support = Shape::support;
  using Columns = double[Dim][support][lane_count];

  alignas(lane_alignment) Columns weight;
  alignas(lane_alignment) Columns gradient;         ///< 1/m
  alignas(lane_alignment) Columns offset;           ///< x_i - x_p, m; filled by `measure_offsets`
  alignas(lane_alignment) double base[lane_count];  ///< first node, local numbering (whole numbers)

  [[gnu::always_inline]] Stencil(const Lanes (&position)[Dim], const GridFrame<Dim>& frame,
                                 const Shape& shape)
  {
    Lanes node = 0.0;
    for (int d = 0; d < Dim; ++d) {
      // Measured from node 0 of the whole grid: the same bits on any number of ranks.
      const Lanes x = (position[d] - frame.origin[d]) * frame.inverse_spacing[d];
      const Lanes first = stdx::floor(x - shape.base_shift());
      Lanes w[support], g[support];
      shape.weights(x - first, frame.gradient_scale[d], w, g);
      for (int a = 0; a < support; ++a) {
        store(w[a], weight[d][a]);
        store(g[a], gradient[d][a]);
      }
      node += (first - frame.lower[d]) * frame.stride[d];
      local_[d] = x - first;
    }
    store(node, base);
  }

  /// For the affine schemes.
  void measure_offsets(const GridFrame<Dim>& frame)
  {
    for (int d = 0; d < Dim; ++d)
      for (int a = 0; a < support; ++a)
        store((double(a) - local_[d]) * frame.spacing[d], offset[d][a]);
  }

  /// Weights w (x_i - x_p) / D with D = sum w (x_i - x_p)^2 per axis, for APIC. For linear
  /// functions they equal the gradients, and are taken as such: D vanishes on grid lines.
  void affine_weights(Columns& affine) const
  {
    for (int d = 0; d < Dim; ++d) {
      if constexpr (support == 2) {
        std::copy_n(&gradient[d][0][0], support * lane_count, &affine[d][0][0]);
      } else {
        Lanes moment = 0.0;
        for (int a = 0; a < support; ++a)
          moment += load(weight[d][a]) * load(offset[d][a]) * load(offset[d][a]);
        for (int a = 0; a < support; ++a)
          store(load(weight[d][a]) * load(offset[d][a]) / moment, affine[d][a]);
      }
    }
  }

 private:
  Lanes local_[Dim];  ///< position from the first node, in cells
};

}  // namespace mpm
