#pragma once
/// One-dimensional weights at one position, read out of the lanes.

#include <mpm/core/lanes.hpp>
#include <mpm/shape/carries_domain.hpp>

#include <array>
#include <cmath>

namespace mpm {

/// Node k of the stencil lies at (base + k) h.
template <int Support>
struct SampledShape {
  int base;
  std::array<double, Support> weight, gradient;

  /// 0 for nodes outside the stencil.
  double weight_of(int node) const { return of(weight, node); }
  double gradient_of(int node) const { return of(gradient, node); }

 private:
  double of(const std::array<double, Support>& values, int node) const
  {
    const int k = node - base;
    return k < 0 || k >= Support ? 0.0 : values[k];
  }
};

template <class Shape>
SampledShape<Shape::support> sample(const Shape& shape, double x, double h = 1)
{
  const double base = std::floor(x / h - shape.base_shift());
  SampledShape<Shape::support> result{int(base), {}, {}};
  if constexpr (CarriesDomain<Shape>) {
    // Of a particle as it was made, in the plane; summed over the nodes of each column.
    constexpr int nodes = Shape::template nodes<2>;
    alignas(lane_alignment) double w[nodes][lane_count], g[2][nodes][lane_count];
    const Lanes axes[4] = {shape.half_size, 0.0, 0.0, shape.half_size};
    const Lanes place[2] = {x / h - base, 1.3};
    shape.template weights<2>(place, axes, {1 / h, 1 / h}, w, g);
    for (int k = 0; k < nodes; ++k) {
      result.weight[k % Shape::support] += w[k][0];
      result.gradient[k % Shape::support] += g[0][k][0];
    }
  } else {
    Lanes w[Shape::support], g[Shape::support];
    shape.weights(Lanes(x / h - base), 1 / h, w, g);
    for (int k = 0; k < Shape::support; ++k) {
      result.weight[k] = w[k][0];
      result.gradient[k] = g[k][0];
    }
  }
  return result;
}

}  // namespace mpm
