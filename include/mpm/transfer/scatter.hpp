#pragma once
/// From one block of particles to the grid.

#include <mpm/materials/law.hpp>
#include <mpm/transfer/stencil.hpp>

namespace mpm {

/// What a pass adds to the nodes.
struct ScatterContent {
  bool mass = false, momentum = false, force = false, remap = false;
};

/// Sums contributions in registers while particles share their first node (they are sorted by it),
/// and adds them to the nodes when the first node changes.
template <int Dim, class Shape, ScatterContent Content>
class Scatter {
  static constexpr int n = Shape::support;
  static constexpr int rows = Dim == 3 ? n * n : n;
  static constexpr int width =
      Content.remap ? NodeGrid<Dim>::remap_width : NodeGrid<Dim>::record_width;
  using R = Record<width>;
  using MassRow = Record<4>;

 public:
  explicit Scatter(NodeGrid<Dim>& grid)
      : grid_(grid),
        target_(Content.remap ? grid.remapped_momentum.data() : grid.momentum_force.data())
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
    const auto &w = stencil.weight, &g = stencil.gradient, &offset = stencil.offset;
    alignas(lane_alignment) double m[lane_count];
    alignas(lane_alignment) double mv[Dim][lane_count];
    alignas(lane_alignment) double mc[Dim * Dim][lane_count];
    store(mass, m);
    for (int d = 0; d < Dim; ++d) store(momentum[d], mv[d]);
    if constexpr (Affine)
      for (int k = 0; k < Dim * Dim; ++k) store(affine[k], mc[k]);

    for (int lane = 0; lane < lane_count; ++lane) {
      const LocalIndex base = LocalIndex(stencil.base[lane]);
      if (base != base_) {
        flush();
        clear();
        base_ = base;
      }
      // Column j of V0 tau times the gradient's component j.
      R plain = R([&](auto k) { return momentum_at(mv, k, lane); });
      R tau[Dim], along[Dim];
      for (int j = 0; j < Dim; ++j) {
        if constexpr (Content.force)
          tau[j] = R([&](auto k) { return stress_at(force_stress, k, j, lane); });
        if constexpr (Affine)
          along[j] = R([&](auto k) { return k < Dim ? mc[k + Dim * j][lane] : 0.0; });
      }
      const MassRow mass_row =
          MassRow([&](auto k) { return k < n ? w[0][k][lane] : 0.0; }) * m[lane];
      for (int row = 0; row < rows; ++row) {
        const int b = row % n, c = row / n;
        double w_row = w[1][b][lane];
        if constexpr (Dim == 3) w_row *= w[2][c][lane];
        if constexpr (Content.mass) mass_[row] += mass_row * w_row;
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
          R& sum = sum_[row * n + a];
          sum += at_row * w[0][a][lane];
          if constexpr (Content.force) sum += (tau[0] * w_row) * g[0][a][lane];
          if constexpr (Affine) sum += (along[0] * w_row) * (w[0][a][lane] * offset[0][a][lane]);
        }
      }
    }
  }

 private:
  static double momentum_at(const double (&mv)[Dim][lane_count], int k, int lane)
  {
    return (Content.momentum || Content.remap) && k < Dim ? mv[k][lane] : 0.0;
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

  void clear()
  {
    for (R& s : sum_) s = 0.0;
    if constexpr (Content.mass)
      for (MassRow& s : mass_) s = 0.0;
  }

  void flush()
  {
    if (base_ < 0) return;
    for (int row = 0; row < rows; ++row) {
      std::size_t node = base_ + std::size_t(row % n) * grid_.stride(1);
      if constexpr (Dim == 3) node += std::size_t(row / n) * grid_.stride(2);
      for (int a = 0; a < n; ++a) {
        double* record = target_ + (node + a) * width;
        (R(record, stdx::element_aligned) + sum_[row * n + a])
            .copy_to(record, stdx::element_aligned);
      }
      if constexpr (Content.mass) {
        double* m = grid_.mass.data() + node;
        (MassRow(m, stdx::element_aligned) + mass_[row]).copy_to(m, stdx::element_aligned);
      }
    }
  }

  NodeGrid<Dim>& grid_;
  double* target_;
  LocalIndex base_ = -1;
  R sum_[rows * n];
  MassRow mass_[rows];
};

}  // namespace mpm
