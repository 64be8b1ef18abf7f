#pragma once
/// Matrices of one cell with linear functions along each axis: products of those of an edge,
/// mass h / 6 {2, 1; 1, 2} and stiffness 1 / h {1, -1; -1, 1}.

#include <mpm/core/types.hpp>

#include <vector>

namespace mpm {

template <int Dim>
class LinearCell {
 public:
  explicit LinearCell(const Vec<Dim>& spacing)
  {
    constexpr int nodes = 1 << Dim;
    for (int i = 0; i < nodes; ++i)
      for (int j = 0; j < nodes; ++j) {
        mass_.push_back(product(spacing, i, j, Dim));
        double stiffness = 0;
        for (int d = 0; d < Dim; ++d) stiffness += product(spacing, i, j, d);
        stiffness_.push_back(stiffness);
      }
  }

  // [nodes * nodes], nodes x fastest.
  const std::vector<double>& mass() const { return mass_; }
  const std::vector<double>& stiffness() const { return stiffness_; }

 private:
  /// Of the edges' masses, but of the stiffness along `derived`.
  static double product(const Vec<Dim>& spacing, int i, int j, int derived)
  {
    double value = 1;
    for (int d = 0; d < Dim; ++d) {
      const bool same = ((i >> d) & 1) == ((j >> d) & 1);
      value *= d == derived ? (same ? 1 : -1) / spacing[d] : spacing[d] / (same ? 3 : 6);
    }
    return value;
  }

  std::vector<double> mass_, stiffness_;
};

}  // namespace mpm
