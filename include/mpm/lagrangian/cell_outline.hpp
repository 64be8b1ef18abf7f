#pragma once
/// Where contact sees the corners of a cell of the plane whose nodes stand beside the wall's
/// surface.

#include <mpm/core/types.hpp>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace mpm {

/// A corner stands off its node by fixed shares of the cell's two diagonals, as a place of the
/// reference configuration does in the cell's mean deformation:
///   x'_k = x_k + s_k0 (x_2 - x_0) + s_k1 (x_3 - x_1).
/// It is linear in the nodes, and shares of opposite nodes cancel: what pushes at x'_k pushes its
/// nodes with the same force and the same moment. Corners in the order of CellOverlaps<2>.
class CellOutline {
 public:
  static constexpr std::size_t corners = 4;

  /// `rest`: of the nodes, m; `ways` from there to the surface, m. None where all ways are 0.
  static std::optional<CellOutline> at(const std::array<Vec<2>, corners>& rest,
                                       const std::array<Vec<2>, corners>& ways)
  {
    Eigen::Matrix2d diagonals;
    diagonals << rest[2] - rest[0], rest[3] - rest[1];
    const Eigen::Matrix2d inverse = diagonals.inverse();
    CellOutline outline;
    bool any = false;
    for (std::size_t k = 0; k < corners; ++k) {
      any = any || !ways[k].isZero(0);
      outline.shares_[k] = inverse * ways[k];
    }
    if (!any) return std::nullopt;
    return outline;
  }

  /// From values of the nodes to those of the corners.
  template <class Value>
  void take_corners(std::array<Value, corners>& values) const
  {
    const Value one = values[2] - values[0], other = values[3] - values[1];
    for (std::size_t k = 0; k < corners; ++k)
      values[k] += shares_[k][0] * one + shares_[k][1] * other;
  }
  /// From what pushes the corners to what the nodes have of it: the transpose.
  template <class Value>
  void give_nodes(std::array<Value, corners>& values) const
  {
    Value one = shares_[0][0] * values[0], other = shares_[0][1] * values[0];
    for (std::size_t k = 1; k < corners; ++k) {
      one += shares_[k][0] * values[k];
      other += shares_[k][1] * values[k];
    }
    values[0] -= one;
    values[1] -= other;
    values[2] += one;
    values[3] += other;
  }
  /// How a corner moves with the nodes.
  std::array<double, corners> weights(std::size_t corner) const
  {
    std::array<double, corners> weights{};
    weights[corner] = 1;
    give_nodes(weights);
    return weights;
  }
  /// Way of a corner over that of the nodes, at most.
  double reach() const
  {
    double most = 0;
    for (std::size_t k = 0; k < corners; ++k) {
      double sum = 0;
      for (const double weight : weights(k)) sum += std::abs(weight);
      most = std::fmax(most, sum);
    }
    return most;
  }

 private:
  std::array<Vec<2>, corners> shares_;
};

}  // namespace mpm
