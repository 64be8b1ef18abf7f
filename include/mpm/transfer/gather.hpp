#pragma once
/// From the grid to one block of particles.

#include <mpm/core/transpose.hpp>
#include <mpm/grid/node_fields.hpp>
#include <mpm/transfer/stencil.hpp>

namespace mpm {

/// The first Count values of each lane's row of Width as lanes.
template <int Width, int Count>
[[gnu::always_inline]] inline void first_columns(const double* rows, Lanes (&values)[Count])
{
  for (int first = 0; first < Count; first += 4) {
    Lanes columns[4];
    to_columns(rows + first, Width, columns);
    std::copy_n(columns, std::min(4, Count - first), values + first);
  }
}

/// f(lane) for one lane after the other. Where stencils have few nodes without a loop: what is
/// gathered then stays in registers until it is turned into columns (a step in the plane costs 1 to
/// 6 % less), where they have many the code would be too long (one of GIMP in space 4 % more).
template <int Dim, class Shape, class Function>
[[gnu::always_inline]] inline void for_each_lane(const Function& f)
{
  constexpr int n = Shape::support, nodes = Dim == 3 ? n * n * n : n * n;
  if constexpr (nodes <= 9) {
#pragma GCC unroll 8
    for (int lane = 0; lane < lane_count; ++lane) f(lane);
  } else {
    for (int lane = 0; lane < lane_count; ++lane) f(lane);
  }
}

/// dv_i/dx_j at i + Dim * j, 1/s, of the grid's gradient velocity.
template <int Dim, class Shape>
[[gnu::always_inline]] inline void gather_gradient(const Stencil<Dim, Shape>& stencil,
                                                   const GridTopology<Dim>& grid,
                                                   const NodeFields<Dim>& fields, double* gradient)
{
  constexpr int n = Shape::support;
  constexpr int width = NodeFields<Dim>::velocity_width;
  constexpr int row_width = Dim == 2 ? 4 : 12;
  const auto &w = stencil.weight, &g = stencil.gradient;
  alignas(lane_alignment) double row_of[lane_count][row_width];
  for_each_lane<Dim, Shape>([&](int lane) __attribute__((always_inline)) {
    const double* node = fields.gradient_velocity.data() + std::size_t(stencil.base[lane]) * width;
    if constexpr (Dim == 2) {
      // {vx, vy, vx, vy} times {g, g, w, w} along x, then {w, w, g, g} along y: both columns of
      // the gradient in one register.
      const std::size_t row = std::size_t(grid.stride(1)) * width;
      Record<4> along_x[n], total = 0.0;
      for (int a = 0; a < n; ++a) along_x[a] = pairs(g[0][a][lane], w[0][a][lane]);
      for (int b = 0; b < n; ++b) {
        Record<4> sum = 0.0;
        for (int a = 0; a < n; ++a)
          sum += Record<4>(node + b * row + a * width, stdx::element_aligned) * along_x[a];
        total += sum * pairs(w[1][b][lane], g[1][b][lane]);
      }
      total.copy_to(row_of[lane], stdx::element_aligned);
    } else {
      Record<4> column[3] = {0.0, 0.0, 0.0};
      for (int c = 0; c < n; ++c) {
        Record<4> gx = 0.0, gy = 0.0, plain = 0.0;
        for (int b = 0; b < n; ++b) {
          Record<4> row_gradient = 0.0, row = 0.0;
          for (int a = 0; a < n; ++a) {
            const Record<4> v(
                node +
                    (std::size_t(c) * grid.stride(2) + std::size_t(b) * grid.stride(1) + a) * width,
                stdx::element_aligned);
            row_gradient += v * g[0][a][lane];
            row += v * w[0][a][lane];
          }
          gx += row_gradient * w[1][b][lane];
          gy += row * g[1][b][lane];
          plain += row * w[1][b][lane];
        }
        column[0] += gx * w[2][c][lane];
        column[1] += gy * w[2][c][lane];
        column[2] += plain * g[2][c][lane];
      }
      for (int j = 0; j < 3; ++j) column[j].copy_to(&row_of[lane][4 * j], stdx::element_aligned);
    }
  });
  constexpr int together = Dim == 2 ? 4 : 3;  // values in a group of four
  for (int k = 0; k < Dim * Dim; k += together) {
    Lanes columns[together];
    first_columns<row_width>(row_of[0] + k / together * 4, columns);
    for (int i = 0; i < together; ++i) store(columns[i], gradient + (k + i) * lane_count);
  }
}

/// Sum w v of the grid's gradient velocity, m/s.
template <int Dim, class Shape>
[[gnu::always_inline]] inline void gather_gradient_velocity(const Stencil<Dim, Shape>& stencil,
                                                            const GridTopology<Dim>& grid,
                                                            const NodeFields<Dim>& fields,
                                                            Lanes (&velocity)[Dim])
{
  constexpr int n = Shape::support, layers = Dim == 3 ? n : 1;
  constexpr int width = NodeFields<Dim>::velocity_width;
  const auto& w = stencil.weight;
  alignas(lane_alignment) double out[lane_count][width];
  for_each_lane<Dim, Shape>([&](int lane) __attribute__((always_inline)) {
    const double* first = fields.gradient_velocity.data() + std::size_t(stencil.base[lane]) * width;
    Record<width> total = 0.0;
    for (int c = 0; c < layers; ++c)
      for (int b = 0; b < n; ++b) {
        std::size_t at = b * std::size_t(grid.stride(1));
        double across = w[1][b][lane];
        if constexpr (Dim == 3) {
          at += c * std::size_t(grid.stride(2));
          across *= w[2][c][lane];
        }
        Record<width> row = 0.0;
        for (int a = 0; a < n; ++a)
          row += Record<width>(first + (at + a) * width, stdx::element_aligned) * w[0][a][lane];
        total += row * across;
      }
    total.copy_to(out[lane], stdx::element_aligned);
  });
  first_columns<width>(out[0], velocity);
}

/// Divergence, 1/s, of a velocity gradient as `gather_gradient` leaves it.
template <int Dim>
[[gnu::always_inline]] inline Lanes trace_of(const double* gradient)
{
  Lanes trace = 0.0;
  for (int d = 0; d < Dim; ++d) trace += load(gradient + d * (Dim + 1) * lane_count);
  return trace;
}

/// Sum w div of the divergences around the nodes, 1/s (NodeFields::divergence_from_remap).
template <int Dim, class Shape>
[[gnu::always_inline]] inline Lanes gather_divergence(const Stencil<Dim, Shape>& stencil,
                                                      const GridTopology<Dim>& grid,
                                                      const NodeFields<Dim>& fields)
{
  constexpr int n = Shape::support, layers = Dim == 3 ? n : 1;
  const auto& w = stencil.weight;
  return Lanes([&](int lane) {
    double sum = 0;
    for (int c = 0; c < layers; ++c)
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) {
          std::size_t node = std::size_t(stencil.base[lane]) + b * std::size_t(grid.stride(1)) + a;
          double weight = w[0][a][lane] * w[1][b][lane];
          if constexpr (Dim == 3) {
            node += c * std::size_t(grid.stride(2));
            weight *= w[2][c][lane];
          }
          sum += weight * fields.remapped_momentum[node * NodeFields<Dim>::remap_width];
        }
    return sum;
  });
}

/// Gives a velocity gradient the divergence of the nodes.
template <int Dim, class Shape>
[[gnu::always_inline]] inline void take_divergence(const Stencil<Dim, Shape>& stencil,
                                                   const GridTopology<Dim>& grid,
                                                   const NodeFields<Dim>& fields, double* gradient)
{
  const Lanes averaged = gather_divergence(stencil, grid, fields);
  const Lanes share = (averaged - trace_of<Dim>(gradient)) / double(Dim);
  for (int d = 0; d < Dim; ++d) {
    double* diagonal = gradient + d * (Dim + 1) * lane_count;
    store(load(diagonal) + share, diagonal);
  }
}

/// Sum w {v, dv} of the updated velocities; with `Affine` also C_ij = sum v_i c_j at i + Dim * j,
/// c the affine weights.
template <bool Affine, int Dim, class Shape>
[[gnu::always_inline]] inline void gather_velocity(
    const Stencil<Dim, Shape>& stencil, const GridTopology<Dim>& grid,
    const NodeFields<Dim>& fields, const typename Stencil<Dim, Shape>::Columns& affine_weight,
    Lanes (&velocity)[2 * Dim], Lanes (&affine)[Dim * Dim])
{
  constexpr int n = Shape::support;
  constexpr int width = NodeFields<Dim>::record_width;
  using R = Record<width>;
  const auto& w = stencil.weight;
  const auto& c = affine_weight;
  alignas(lane_alignment) double out[lane_count][width];
  alignas(lane_alignment) double out_affine[Dim][lane_count][width];
  constexpr int layers = Dim == 3 ? n : 1;
  for_each_lane<Dim, Shape>([&](int lane) __attribute__((always_inline)) {
    const double* node = fields.updated.data() + std::size_t(stencil.base[lane]) * width;
    R total = 0.0, total_affine[Dim];
    for (R& t : total_affine) t = 0.0;
    for (int k = 0; k < layers; ++k) {
      R layer = 0.0, layer_x = 0.0, layer_y = 0.0;
      for (int b = 0; b < n; ++b) {
        R row = 0.0, row_x = 0.0;
        for (int a = 0; a < n; ++a) {
          std::size_t at = std::size_t(b) * grid.stride(1) + a;
          if constexpr (Dim == 3) at += std::size_t(k) * grid.stride(2);
          const R value(node + at * width, stdx::element_aligned);
          row += value * w[0][a][lane];
          if constexpr (Affine) row_x += value * c[0][a][lane];
        }
        layer += row * w[1][b][lane];
        if constexpr (Affine) {
          layer_x += row_x * w[1][b][lane];
          layer_y += row * c[1][b][lane];
        }
      }
      if constexpr (Dim == 3) {
        total += layer * w[2][k][lane];
        if constexpr (Affine) {
          total_affine[0] += layer_x * w[2][k][lane];
          total_affine[1] += layer_y * w[2][k][lane];
          total_affine[2] += layer * c[2][k][lane];
        }
      } else {
        total = layer;
        total_affine[0] = layer_x;
        total_affine[1] = layer_y;
      }
    }
    total.copy_to(out[lane], stdx::element_aligned);
    if constexpr (Affine)
      for (int j = 0; j < Dim; ++j)
        total_affine[j].copy_to(out_affine[j][lane], stdx::element_aligned);
  });
  first_columns<width>(out[0], velocity);
  if constexpr (Affine)
    for (int j = 0; j < Dim; ++j) {
      Lanes column[Dim];
      first_columns<width>(out_affine[j][0], column);
      std::copy_n(column, Dim, &affine[Dim * j]);
    }
}

}  // namespace mpm
