#pragma once
/// Weights of one block of particles whose shape function depends on a domain that they carry:
/// node by node, because they are no products of one-dimensional ones.

#include <mpm/core/lane_matrix.hpp>
#include <mpm/shape/carries_domain.hpp>
#include <mpm/transfer/stencil.hpp>

namespace mpm {

template <int Dim, CarriesDomain Shape>
struct Stencil<Dim, Shape> {
  static constexpr int support = Shape::support;
  static constexpr int nodes = Shape::template nodes<Dim>;
  using Columns = double[Dim][nodes][lane_count];

  // Nodes with x fastest.
  alignas(lane_alignment) double weight[nodes][lane_count];
  alignas(lane_alignment) Columns gradient;  ///< 1/m
  /// x_i - x_p per axis, m; filled by `measure_offsets`
  alignas(lane_alignment) double offset[Dim][support][lane_count];
  alignas(lane_alignment) double base[lane_count];  ///< first node, local numbering (whole numbers)

  /// `domain`: half axes as the column of this name has them, m.
  [[gnu::always_inline]] Stencil(const Lanes (&position)[Dim], const Lanes (&domain)[Dim * Dim],
                                 const GridFrame<Dim>& frame, const Shape& shape)
  {
    Lanes node = 0.0, axes[Dim * Dim];
    for (int d = 0; d < Dim; ++d) {
      // Measured from node 0 of the whole grid: the same bits on any number of ranks.
      const Lanes x = (position[d] - frame.origin[d]) * frame.inverse_spacing[d];
      const Lanes first = stdx::floor(x - shape.base_shift());
      node += (first - frame.lower[d]) * frame.stride[d];
      local_[d] = x - first;
      for (int k = 0; k < Dim; ++k)
        axes[d + Dim * k] = domain[d + Dim * k] * frame.inverse_spacing[d];
    }
    store(node, base);
    shape.template limit<Dim>(axes);
    shape.template weights<Dim>(local_, axes, frame.gradient_scale, weight, gradient);
  }

  /// For the affine schemes.
  void measure_offsets(const GridFrame<Dim>& frame)
  {
    for (int d = 0; d < Dim; ++d)
      for (int a = 0; a < support; ++a)
        store((double(a) - local_[d]) * frame.spacing[d], offset[d][a]);
  }

  /// Weights w D^-1 (x_i - x_p) with D = sum w (x_i - x_p) (x) (x_i - x_p), for APIC. D is never
  /// singular: it is at least R R^T of the domain.
  void affine_weights(Columns& affine) const
  {
    Lanes moment[Dim * Dim], inverse[Dim * Dim];
    for (Lanes& component : moment) component = 0.0;
    for (int node = 0; node < nodes; ++node)
      for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
          moment[i + Dim * j] += load(weight[node]) * offset_of(i, node) * offset_of(j, node);
    invert<Dim>(moment, inverse);
    for (int node = 0; node < nodes; ++node)
      for (int i = 0; i < Dim; ++i) {
        Lanes sum = 0.0;
        for (int j = 0; j < Dim; ++j) sum += inverse[i + Dim * j] * offset_of(j, node);
        store(load(weight[node]) * sum, affine[i][node]);
      }
  }

 private:
  Lanes offset_of(int axis, int node) const
  {
    for (int d = 0; d < axis; ++d) node /= support;
    return load(offset[axis][node % support]);
  }

  Lanes local_[Dim];  ///< position from the first node, in cells
};

/// Visits the nodes of a stencil: number in the stencil, number from its first node on the grid.
template <int Dim, CarriesDomain Shape, class Visit>
[[gnu::always_inline]] inline void for_each_node(const GridTopology<Dim>& grid, const Visit& visit)
{
  constexpr int n = Shape::support, layers = Dim == 3 ? n : 1;
  for (int c = 0; c < layers; ++c)
    for (int b = 0; b < n; ++b) {
      std::size_t row = b * std::size_t(grid.stride(1));
      if constexpr (Dim == 3) row += c * std::size_t(grid.stride(2));
      for (int a = 0; a < n; ++a) visit((c * n + b) * n + a, row + a);
    }
}

}  // namespace mpm
