#pragma once
/// One-dimensional weights at one position, read out of the lanes.

#include <mpm/core/lanes.hpp>

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
  Lanes w[Shape::support], g[Shape::support];
  const double base = std::floor(x / h - shape.base_shift());
  shape.weights(Lanes(x / h - base), 1 / h, w, g);
  SampledShape<Shape::support> result{int(base), {}, {}};
  for (int k = 0; k < Shape::support; ++k) {
    result.weight[k] = w[k][0];
    result.gradient[k] = g[k][0];
  }
  return result;
}

}  // namespace mpm
