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

/// A corner is a place of the cell, and goes where the cell's bilinear map takes that:
///   x'_k = sum_i N_i(xi_k) x_i,   N the bilinear shape functions, xi_k fixed at rest.
/// It is linear in the nodes, and shares sum to one: what pushes at x'_k pushes its nodes with the
/// same force and the same moment. Corners in the order of CellOverlaps<2>.
class CellOutline {
 public:
  static constexpr std::size_t corners = 4;

  /// `rest`: of the nodes, m; `ways` from there to the corners, m. None where all ways are 0.
  static std::optional<CellOutline> at(const std::array<Vec<2>, corners>& rest,
                                       const std::array<Vec<2>, corners>& ways)
  {
    CellOutline outline;
    bool any = false;
    for (std::size_t k = 0; k < corners; ++k) {
      any = any || !ways[k].isZero(0);
      outline.shares_[k] = shares_at(rest, k, ways[k]);
    }
    if (!any) return std::nullopt;
    return outline;
  }

  /// From values of the nodes to those of the corners.
  template <class Value>
  void take_corners(std::array<Value, corners>& values) const
  {
    const std::array<Value, corners> of_nodes = values;
    for (std::size_t k = 0; k < corners; ++k) {
      values[k] = shares_[k][0] * of_nodes[0];
      for (std::size_t i = 1; i < corners; ++i) values[k] += shares_[k][i] * of_nodes[i];
    }
  }
  /// From what pushes the corners to what the nodes have of it: the transpose.
  template <class Value>
  void give_nodes(std::array<Value, corners>& values) const
  {
    const std::array<Value, corners> of_corners = values;
    for (std::size_t i = 0; i < corners; ++i) {
      values[i] = shares_[0][i] * of_corners[0];
      for (std::size_t k = 1; k < corners; ++k) values[i] += shares_[k][i] * of_corners[k];
    }
  }
  /// How a corner moves with the nodes.
  const std::array<double, corners>& shares(std::size_t corner) const { return shares_[corner]; }
  /// Way of a corner over that of the nodes, at most.
  double reach() const
  {
    double most = 0;
    for (const auto& shares : shares_) {
      double sum = 0;
      for (const double share : shares) sum += std::abs(share);
      most = std::fmax(most, sum);
    }
    return most;
  }

 private:
  using Shares = std::array<double, corners>;

  /// Counter-clockwise, as the corners are.
  static Shares shape_functions(const Vec<2>& xi)
  {
    const double x[2] = {0.5 * (1 - xi[0]), 0.5 * (1 + xi[0])},
                 y[2] = {0.5 * (1 - xi[1]), 0.5 * (1 + xi[1])};
    return {x[0] * y[0], x[1] * y[0], x[1] * y[1], x[0] * y[1]};
  }
  /// Newton's method from the node on: the map of a convex cell has one answer there.
  static Shares shares_at(const std::array<Vec<2>, corners>& rest, std::size_t corner,
                          const Vec<2>& way)
  {
    constexpr int steps = 30;
    Vec<2> xi(corner == 1 || corner == 2 ? 1 : -1, corner >= 2 ? 1 : -1);
    const Vec<2> sought = rest[corner] + way;
    for (int k = 0; k < steps && !way.isZero(0); ++k) {
      const Shares shares = shape_functions(xi);
      Vec<2> off = -sought;
      for (std::size_t i = 0; i < corners; ++i) off += shares[i] * rest[i];
      const double x = xi[0], y = xi[1];
      Eigen::Matrix2d slopes;
      slopes.col(0) = 0.25 * ((1 - y) * (rest[1] - rest[0]) + (1 + y) * (rest[2] - rest[3]));
      slopes.col(1) = 0.25 * ((1 - x) * (rest[3] - rest[0]) + (1 + x) * (rest[2] - rest[1]));
      xi -= slopes.inverse() * off;
    }
    return shape_functions(xi);
  }

  std::array<Shares, corners> shares_;
};

}  // namespace mpm
