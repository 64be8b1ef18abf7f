#pragma once
/// From the grid to one block of particles that carry a domain.

#include <mpm/transfer/block_columns.hpp>
#include <mpm/transfer/domain_stencil.hpp>
#include <mpm/transfer/gather.hpp>

namespace mpm {

/// dv_i/dx_j at i + Dim * j, 1/s, of node velocities that lie `width` values apart.
template <int Dim, CarriesDomain Shape>
[[gnu::always_inline]] inline void gather_gradient_of(const LaneVector<double>& velocities,
                                                      std::size_t width,
                                                      const Stencil<Dim, Shape>& stencil,
                                                      const GridTopology<Dim>& grid,
                                                      double* gradient)
{
  constexpr int row_width = 4 * Dim;
  alignas(lane_alignment) double row_of[lane_count][row_width];
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* first = velocities.data() + std::size_t(stencil.base[lane]) * width;
    Record<4> column[Dim];
    for (Record<4>& c : column) c = 0.0;
    for_each_node<Dim, Shape>(grid, [&](int node, std::size_t at) {
      const Record<4> v(first + at * width, stdx::element_aligned);
      for (int j = 0; j < Dim; ++j) column[j] += v * stencil.gradient[j][node][lane];
    });
    for (int j = 0; j < Dim; ++j) column[j].copy_to(&row_of[lane][4 * j], stdx::element_aligned);
  }
  for (int j = 0; j < Dim; ++j) {
    Lanes columns[Dim];
    first_columns<row_width>(row_of[0] + 4 * j, columns);
    for (int i = 0; i < Dim; ++i) store(columns[i], gradient + (i + Dim * j) * lane_count);
  }
}

/// Of the grid's gradient velocity.
template <int Dim, CarriesDomain Shape>
[[gnu::always_inline]] inline void gather_gradient(const Stencil<Dim, Shape>& stencil,
                                                   const GridTopology<Dim>& grid,
                                                   const NodeFields<Dim>& fields, double* gradient)
{
  gather_gradient_of(fields.gradient_velocity, NodeFields<Dim>::velocity_width, stencil, grid,
                     gradient);
}

/// As that of tensor products.
template <int Dim, CarriesDomain Shape>
[[gnu::always_inline]] inline void gather_gradient_velocity(const Stencil<Dim, Shape>& stencil,
                                                            const GridTopology<Dim>& grid,
                                                            const NodeFields<Dim>& fields,
                                                            Lanes (&velocity)[Dim])
{
  constexpr int width = NodeFields<Dim>::velocity_width;
  alignas(lane_alignment) double out[lane_count][width];
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* first = fields.gradient_velocity.data() + std::size_t(stencil.base[lane]) * width;
    Record<width> total = 0.0;
    for_each_node<Dim, Shape>(grid, [&](int node, std::size_t at) {
      total +=
          Record<width>(first + at * width, stdx::element_aligned) * stencil.weight[node][lane];
    });
    total.copy_to(out[lane], stdx::element_aligned);
  }
  first_columns<width>(out[0], velocity);
}

/// Sum w div of the divergences around the nodes, 1/s.
template <int Dim, CarriesDomain Shape>
[[gnu::always_inline]] inline Lanes gather_divergence(const Stencil<Dim, Shape>& stencil,
                                                      const GridTopology<Dim>& grid,
                                                      const NodeFields<Dim>& fields)
{
  return Lanes([&](int lane) {
    const double* first = fields.remapped_momentum.data() +
                          std::size_t(stencil.base[lane]) * NodeFields<Dim>::remap_width;
    double sum = 0;
    for_each_node<Dim, Shape>(grid, [&](int node, std::size_t at) {
      sum += stencil.weight[node][lane] * first[at * NodeFields<Dim>::remap_width];
    });
    return sum;
  });
}

/// As that of tensor products.
template <bool Affine, int Dim, CarriesDomain Shape>
[[gnu::always_inline]] inline void gather_velocity(
    const Stencil<Dim, Shape>& stencil, const GridTopology<Dim>& grid,
    const NodeFields<Dim>& fields, const typename Stencil<Dim, Shape>::Columns& affine_weight,
    Lanes (&velocity)[2 * Dim], Lanes (&affine)[Dim * Dim])
{
  constexpr int width = NodeFields<Dim>::record_width;
  using R = Record<width>;
  alignas(lane_alignment) double out[lane_count][width];
  alignas(lane_alignment) double out_affine[Dim][lane_count][width];
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* first = fields.updated.data() + std::size_t(stencil.base[lane]) * width;
    R total = 0.0, total_affine[Dim];
    for (R& t : total_affine) t = 0.0;
    for_each_node<Dim, Shape>(grid, [&](int node, std::size_t at) {
      const R value(first + at * width, stdx::element_aligned);
      total += value * stencil.weight[node][lane];
      if constexpr (Affine)
        for (int j = 0; j < Dim; ++j) total_affine[j] += value * affine_weight[j][node][lane];
    });
    total.copy_to(out[lane], stdx::element_aligned);
    if constexpr (Affine)
      for (int j = 0; j < Dim; ++j)
        total_affine[j].copy_to(out_affine[j][lane], stdx::element_aligned);
  }
  first_columns<width>(out[0], velocity);
  if constexpr (Affine)
    for (int j = 0; j < Dim; ++j) {
      Lanes column[Dim];
      first_columns<width>(out_affine[j][0], column);
      std::copy_n(column, Dim, &affine[Dim * j]);
    }
}

/// r_k += dt L r_k of the half axes, in place; `gradient` as `gather_gradient` leaves it.
template <int Dim>
[[gnu::always_inline]] inline void carry_domain(const double* gradient, double dt, double* domain)
{
  for (int k = 0; k < Dim; ++k) {
    Lanes axis[Dim];
    load_all(domain, Dim * k, axis);
    for (int i = 0; i < Dim; ++i) {
      Lanes rate = 0.0;
      for (int j = 0; j < Dim; ++j) rate += load(gradient + (i + Dim * j) * lane_count) * axis[j];
      store(axis[i] + dt * rate, domain + (i + Dim * k) * lane_count);
    }
  }
}

}  // namespace mpm
