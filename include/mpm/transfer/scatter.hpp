#pragma once
/// From one block of particles to the grid.

#include <mpm/grid/node_fields.hpp>
#include <mpm/materials/law.hpp>
#include <mpm/transfer/domain_stencil.hpp>
#include <mpm/transfer/pass_content.hpp>

#include <algorithm>

namespace mpm {

/// Sums contributions in registers while particles share their first node (they are sorted by it),
/// and adds them to the nodes when the first node changes. Blocks in which it changes often, as in
/// crumpled walls, add each particle to the nodes at once: no processor foretells those changes.
template <int Dim, class Shape, ScatterContent Content>
class Scatter {
  static constexpr int n = Shape::support;
  static constexpr int rows = Dim == 3 ? n * n : n;
  static constexpr int width =
      Content.remap ? NodeFields<Dim>::remap_width : NodeFields<Dim>::record_width;
  using R = Record<width>;
  using MassRow = Record<4>;
  /// In a row of its own, or in the record of momentum and force.
  static constexpr bool mass_apart = Content.mass && !NodeFields<Dim>::mass_slot;

 public:
  Scatter(const GridTopology<Dim>& grid, NodeFields<Dim>& fields)
      : grid_(grid),
        mass_of_nodes_(fields.mass.data()),
        target_(Content.remap ? fields.remapped_momentum.data() : fields.momentum_force.data())
  {
    clear();
  }
  ~Scatter() { flush(); }
  Scatter(const Scatter&) = delete;
  Scatter& operator=(const Scatter&) = delete;

  /// momentum [Dim], mass, force_stress [symmetric_components] (columns of lanes, V0 tau),
  /// affine [Dim * Dim] (m C_ij at i + Dim * j). Absent ones are ignored.
  template <bool Affine>
  [[gnu::always_inline]] void add(const Stencil<Dim, Shape>& stencil, const Lanes& mass,
                                  const Lanes (&momentum)[Dim], const double* force_stress,
                                  const Lanes (&affine)[Dim * Dim])
  {
    alignas(lane_alignment) Columns columns;
    store(mass, columns.mass);
    for (int d = 0; d < Dim; ++d) store(momentum[d], columns.momentum[d]);
    if constexpr (Affine)
      for (int k = 0; k < Dim * Dim; ++k) store(affine[k], columns.affine[k]);

    if (changes_of_node(stencil) <= most_changes) {
      add_lanes<Affine, true>(stencil, columns, force_stress);
    } else {
      flush();
      base_ = -1;
      add_lanes<Affine, false>(stencil, columns, force_stress);
    }
  }

 private:
  struct Columns {
    double mass[lane_count], momentum[Dim][lane_count], affine[Dim * Dim][lane_count];
  };

  /// A full cell of four particles changes the first node twice in eight lanes.
  static constexpr int most_changes = std::max(1, lane_count * 3 / 8);

  int changes_of_node(const Stencil<Dim, Shape>& stencil) const
  {
    const Lanes before([&](auto k) { return k == 0 ? double(base_) : stencil.base[k - 1]; });
    return stdx::popcount(load(stencil.base) != before);
  }

  template <bool Affine, bool InRegisters>
  [[gnu::always_inline]] void add_lanes(const Stencil<Dim, Shape>& stencil, const Columns& columns,
                                        const double* force_stress)
  {
    const auto& mc = columns.affine;
    for (int lane = 0; lane < lane_count; ++lane) {
      const LocalIndex base = LocalIndex(stencil.base[lane]);
      if constexpr (InRegisters) {
        if (base != base_) {
          flush();
          clear();
          base_ = base;
        }
      }
      // Column j of V0 tau times the gradient's component j.
      R plain = R([&](auto k) { return momentum_at(columns, k, lane); });
      R tau[Dim], along[Dim];
      for (int j = 0; j < Dim; ++j) {
        if constexpr (Content.force)
          tau[j] = R([&](auto k) { return stress_at(force_stress, k, j, lane); });
        if constexpr (Affine)
          along[j] = R([&](auto k) { return k < Dim ? mc[k + Dim * j][lane] : 0.0; });
      }
      add_nodes<Affine, InRegisters>(stencil, base, columns.mass[lane], plain, tau, along, lane);
    }
  }

  /// One particle, whose weights are a tensor product.
  template <bool Affine, bool InRegisters>
  [[gnu::always_inline]] void add_nodes(const Stencil<Dim, Shape>& stencil, LocalIndex base,
                                        double mass, const R& plain, const R (&tau)[Dim],
                                        const R (&along)[Dim], int lane)
  {
    const auto &w = stencil.weight, &g = stencil.gradient, &offset = stencil.offset;
    const MassRow mass_row = MassRow([&](auto k) { return k < n ? w[0][k][lane] : 0.0; }) * mass;
    for (int row = 0; row < rows; ++row) {
      const int b = row % n, c = row / n;
      double w_row = w[1][b][lane];
      if constexpr (Dim == 3) w_row *= w[2][c][lane];
      const std::size_t node = first_of_row(base, row);
      if constexpr (mass_apart) {
        if constexpr (InRegisters)
          mass_[row] += mass_row * w_row;
        else
          add_to(mass_of_nodes_ + node, mass_row * w_row);
      }
      R at_row = plain;  // without the force: times w along x
      if constexpr (Affine) {
        at_row += along[1] * offset[1][b][lane];
        if constexpr (Dim == 3) at_row += along[2] * offset[2][c][lane];
      }
      at_row = at_row * w_row;
      if constexpr (Content.force) {
        if constexpr (Dim == 3)
          at_row +=
              tau[1] * (g[1][b][lane] * w[2][c][lane]) + tau[2] * (w[1][b][lane] * g[2][c][lane]);
        else
          at_row += tau[1] * g[1][b][lane];
      }
      for (int a = 0; a < n; ++a) {
        // Term by term, so that each is one multiply-add.
        double* record = target_ + (node + a) * width;
        R sum = InRegisters ? sum_[row * n + a] : R(record, stdx::element_aligned);
        sum += at_row * w[0][a][lane];
        if constexpr (Content.force) sum += (tau[0] * w_row) * g[0][a][lane];
        if constexpr (Affine) sum += (along[0] * w_row) * (w[0][a][lane] * offset[0][a][lane]);
        if constexpr (InRegisters)
          sum_[row * n + a] = sum;
        else
          sum.copy_to(record, stdx::element_aligned);
      }
    }
  }

  /// One particle, whose weights are given node by node.
  template <bool Affine, bool InRegisters>
  requires CarriesDomain<Shape>
  [[gnu::always_inline]] void add_nodes(const Stencil<Dim, Shape>& stencil, LocalIndex base,
                                        double mass, const R& plain, const R (&tau)[Dim],
                                        const R (&along)[Dim], int lane)
  {
    const auto& w = stencil.weight;
    const auto& g = stencil.gradient;
    const auto& offset = stencil.offset;
    for (int row = 0; row < rows; ++row) {
      const std::size_t node = first_of_row(base, row);
      if constexpr (mass_apart) {
        const MassRow mass_row =
            MassRow([&](auto k) { return k < n ? w[row * n + k][lane] : 0.0; }) * mass;
        if constexpr (InRegisters)
          mass_[row] += mass_row;
        else
          add_to(mass_of_nodes_ + node, mass_row);
      }
      R at_row = plain;
      if constexpr (Affine) {
        at_row += along[1] * offset[1][row % n][lane];
        if constexpr (Dim == 3) at_row += along[2] * offset[2][row / n][lane];
      }
      for (int a = 0; a < n; ++a) {
        const int k = row * n + a;
        double* record = target_ + (node + a) * width;
        R sum = InRegisters ? sum_[k] : R(record, stdx::element_aligned);
        R value = at_row;
        if constexpr (Affine) value += along[0] * offset[0][a][lane];
        sum += value * w[k][lane];
        if constexpr (Content.force)
          for (int j = 0; j < Dim; ++j) sum += tau[j] * g[j][k][lane];
        if constexpr (InRegisters)
          sum_[k] = sum;
        else
          sum.copy_to(record, stdx::element_aligned);
      }
    }
  }

  /// Component k of the record without the force.
  static double momentum_at(const Columns& columns, int k, int lane)
  {
    if (Content.mass && NodeFields<Dim>::mass_slot == k) return columns.mass[lane];
    return (Content.momentum || Content.remap) && k < Dim ? columns.momentum[k][lane] : 0.0;
  }
  /// Component k of the record for column j of V0 tau.
  static double stress_at(const double* s, int k, int j, int lane)
  {
    const int i = k - Dim;
    if (i < 0 || i >= Dim) return 0.0;
    constexpr int voigt2[2][2] = {{0, 2}, {2, 1}};
    constexpr int voigt3[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const int component = Dim == 2 ? voigt2[i % 2][j % 2] : voigt3[i][j];
    return s[component * lane_count + lane];
  }

  // Both inlined in all places, or else the sums would not be registers.
  [[gnu::always_inline]] void clear()
  {
    for (R& s : sum_) s = 0.0;
    if constexpr (mass_apart)
      for (MassRow& s : mass_) s = 0.0;
  }

  std::size_t first_of_row(LocalIndex base, int row) const
  {
    std::size_t node = base + std::size_t(row % n) * grid_.stride(1);
    if constexpr (Dim == 3) node += std::size_t(row / n) * grid_.stride(2);
    return node;
  }
  template <class Values>
  static void add_to(double* place, const Values& values)
  {
    (Values(place, stdx::element_aligned) + values).copy_to(place, stdx::element_aligned);
  }

  [[gnu::always_inline]] void flush()
  {
    if (base_ < 0) return;
    for (int row = 0; row < rows; ++row) {
      const std::size_t node = first_of_row(base_, row);
      for (int a = 0; a < n; ++a) add_to(target_ + (node + a) * width, sum_[row * n + a]);
      if constexpr (mass_apart) add_to(mass_of_nodes_ + node, mass_[row]);
    }
  }

  const GridTopology<Dim>& grid_;
  double* mass_of_nodes_;
  double* target_;
  LocalIndex base_ = -1;
  R sum_[rows * n];
  MassRow mass_[rows];
};

/// Weight of one node of a stencil; `at`: its place in the stencil along each axis.
template <int Dim, class Shape>
double weight_of(const Stencil<Dim, Shape>& stencil, const int (&at)[3], int lane)
{
  double weight = 1;
  for (int d = 0; d < Dim; ++d) weight *= stencil.weight[d][at[d]][lane];
  return weight;
}
template <int Dim, CarriesDomain Shape>
double weight_of(const Stencil<Dim, Shape>& stencil, const int (&at)[3], int lane)
{
  return stencil.weight[(at[2] * Shape::support + at[1]) * Shape::support + at[0]][lane];
}

/// Adds w f to a column of the nodes, one after the other: loads are few.
template <int Dim, class Shape>
void scatter_force(const Stencil<Dim, Shape>& stencil, const GridTopology<Dim>& grid,
                   const Lanes (&force)[Dim], const NodeColumn& column)
{
  constexpr int n = Shape::support, layers = Dim == 3 ? n : 1;
  for (int lane = 0; lane < lane_count; ++lane)
    for (int c = 0; c < layers; ++c)
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) {
          std::size_t node = std::size_t(stencil.base[lane]) + a + b * std::size_t(grid.stride(1));
          double w = stencil.weight[0][a][lane] * stencil.weight[1][b][lane];
          if constexpr (Dim == 3) {
            node += c * std::size_t(grid.stride(2));
            w *= stencil.weight[2][c][lane];
          }
          for (int d = 0; d < Dim; ++d)
            column.values[node * column.stride + d] += w * force[d][lane];
        }
}
template <int Dim, CarriesDomain Shape>
void scatter_force(const Stencil<Dim, Shape>& stencil, const GridTopology<Dim>& grid,
                   const Lanes (&force)[Dim], const NodeColumn& column)
{
  for (int lane = 0; lane < lane_count; ++lane)
    for_each_node<Dim, Shape>(grid, [&](int k, std::size_t from_first) {
      const std::size_t node = std::size_t(stencil.base[lane]) + from_first;
      for (int d = 0; d < Dim; ++d)
        column.values[node * column.stride + d] += stencil.weight[k][lane] * force[d][lane];
    });
}

/// Adds w m r and w m r (x) r, r = x_p - x_i, to nodes (NodeFields::surface_of): only few are asked
/// for it.
template <int Dim, class Shape>
void scatter_surface(const Stencil<Dim, Shape>& stencil, const GridTopology<Dim>& grid,
                     const Lanes& mass, NodeFields<Dim>& fields)
{
  constexpr int n = Shape::support, layers = Dim == 3 ? n : 1;
  for (int lane = 0; lane < lane_count; ++lane)
    for (int c = 0; c < layers; ++c)
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) {
          const int at[3] = {a, b, c};
          LocalIndex node = LocalIndex(stencil.base[lane]) + a + b * grid.stride(1);
          if constexpr (Dim == 3) node += c * grid.stride(2);
          const double share = mass[lane] * weight_of(stencil, at, lane);
          double* first = fields.surface_of(node);
          double* second = first + Dim;
          for (int i = 0; i < Dim; ++i) {
            const double along = -share * stencil.offset[i][at[i]][lane];
            first[i] += along;
            for (int j = i; j < Dim; ++j) *second++ -= along * stencil.offset[j][at[j]][lane];
          }
        }
}

}  // namespace mpm
