#pragma once
/// Tensors in space, one per lane.

#include <mpm/core/lanes.hpp>

namespace mpm {

/// Row by row.
struct Tensor {
  Lanes a[3][3];

  static Tensor identity() { return {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}; }
  Lanes cofactor(int i, int j) const
  {
    const int r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return a[r][c] * a[s][d] - a[r][d] * a[s][c];
  }
  Lanes determinant() const
  {
    return a[0][0] * cofactor(0, 0) + a[0][1] * cofactor(0, 1) + a[0][2] * cofactor(0, 2);
  }
  Tensor transposed() const
  {
    Tensor result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result.a[i][j] = a[j][i];
    return result;
  }
  Tensor inverse() const
  {
    const Lanes scale = 1.0 / determinant();
    Tensor result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result.a[i][j] = cofactor(j, i) * scale;
    return result;
  }
};

inline Tensor operator*(const Tensor& x, const Tensor& y)
{
  Tensor result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result.a[i][j] = x.a[i][0] * y.a[0][j] + x.a[i][1] * y.a[1][j] + x.a[i][2] * y.a[2][j];
  return result;
}

/// Symmetric.
struct Symmetric {
  Lanes xx, yy, zz, xy, yz, xz;

  Lanes trace() const { return xx + yy + zz; }
  Lanes mean() const { return (xx + yy + zz) / 3.0; }
  Lanes squared() const  ///< A : A
  {
    return contracted(*this);
  }
  Symmetric deviator() const
  {
    const Lanes p = mean();
    return {xx - p, yy - p, zz - p, xy, yz, xz};
  }
  Lanes determinant() const
  {
    return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  }
  Symmetric times_itself() const
  {
    return {xx * xx + xy * xy + xz * xz, xy * xy + yy * yy + yz * yz, xz * xz + yz * yz + zz * zz,
            xx * xy + xy * yy + xz * yz, xy * xz + yy * yz + yz * zz, xx * xz + xy * yz + xz * zz};
  }
  friend Symmetric operator+(const Symmetric& a, const Symmetric& b)
  {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.xz + b.xz};
  }
  friend Symmetric operator*(const Lanes& by, const Symmetric& a)
  {
    return {by * a.xx, by * a.yy, by * a.zz, by * a.xy, by * a.yz, by * a.xz};
  }
  Lanes contracted(const Symmetric& b) const  ///< A : B
  {
    return xx * b.xx + yy * b.yy + zz * b.zz + 2.0 * (xy * b.xy + yz * b.yz + xz * b.xz);
  }
  /// Q A Q^T
  [[gnu::always_inline]] Symmetric turned(const Tensor& q) const
  {
    const Tensor m = q * Tensor{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
    const auto at = [&](int i, int j) {
      return m.a[i][0] * q.a[j][0] + m.a[i][1] * q.a[j][1] + m.a[i][2] * q.a[j][2];
    };
    return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(0, 2)};
  }
};

/// Lanes of `target` where the mask holds.
[[gnu::always_inline]] inline void put_where(const LaneMask& mask, const Symmetric& value,
                                             Symmetric& target)
{
  stdx::where(mask, target.xx) = value.xx;
  stdx::where(mask, target.yy) = value.yy;
  stdx::where(mask, target.zz) = value.zz;
  stdx::where(mask, target.xy) = value.xy;
  stdx::where(mask, target.yz) = value.yz;
  stdx::where(mask, target.xz) = value.xz;
}

/// Six columns.
[[gnu::always_inline]] inline Symmetric load_symmetric(const double* columns)
{
  return {load(columns),
          load(columns + lane_count),
          load(columns + 2 * lane_count),
          load(columns + 3 * lane_count),
          load(columns + 4 * lane_count),
          load(columns + 5 * lane_count)};
}
[[gnu::always_inline]] inline void store_scaled(const Symmetric& a, const Lanes& factor,
                                                double* columns)
{
  store(factor * a.xx, columns);
  store(factor * a.yy, columns + lane_count);
  store(factor * a.zz, columns + 2 * lane_count);
  store(factor * a.xy, columns + 3 * lane_count);
  store(factor * a.yz, columns + 4 * lane_count);
  store(factor * a.xz, columns + 5 * lane_count);
}

}  // namespace mpm
