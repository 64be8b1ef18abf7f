#pragma once
/// Cells in space: bricks of eight corners, with the twelve modes that one point does not see
/// (brick_bending.hpp).

#include <mpm/core/lane_matrix.hpp>
#include <mpm/lagrangian/location_cell.hpp>
#include <mpm/materials/space_spectrum.hpp>

namespace mpm {

template <>
struct CellFrame<3> {
  double quarter_inverse[3];  ///< 1 / (4 h), 1/m
  double half[3];             ///< m
  /// Of mode m: what a corner's place, with the mode's sign, gives to it: 1/m^2, the last 1/m^3.
  double share[4];
  double radius_squared;  ///< m^2

  explicit CellFrame(const Vec<3>& size)
      : share{0.5 / (size[1] * size[2]), 0.5 / (size[2] * size[0]), 0.5 / (size[0] * size[1]),
              1 / size.prod()},
        radius_squared(0.25 * size.squaredNorm())
  {
    for (int d = 0; d < 3; ++d) {
      quarter_inverse[d] = 0.25 / size[d];
      half[d] = 0.5 * size[d];
    }
  }
  double inverse_volume() const { return share[3]; }  ///< 1/m^3
};

/// x = x_c + F X + a^0 Y Z + a^1 Z X + a^2 X Y + a^3 X Y Z, seen from the centre, with X, Y and Z
/// along the edges at rest. Mode m < 3 is the one without axis m.
template <>
struct CellDeformation<3> {
  static constexpr int modes = 12;

  Lanes f[9];            ///< F_ij at i + 3 j
  Lanes inverse[9];      ///< of F
  Lanes bending[modes];  ///< b^m = F^-1 a^m at 3 m, 1/m, the last 1/m^2

  /// From columns of F and of what `keep` wrote.
  static constexpr int kept = modes + 9;
  [[gnu::always_inline]] CellDeformation(const double* gradient, const double* columns)
  {
    for (int k = 0; k < 9; ++k) f[k] = column(gradient, k);
    for (int k = 0; k < modes; ++k) bending[k] = column(columns, k);
    for (int k = 0; k < 9; ++k) inverse[k] = column(columns, modes + k);
  }
  [[gnu::always_inline]] void keep(double* columns) const
  {
    for (int k = 0; k < modes; ++k) store(bending[k], columns + k * lane_count);
    for (int k = 0; k < 9; ++k) store(inverse[k], columns + (modes + k) * lane_count);
  }
  [[gnu::always_inline]] CellDeformation(const CellCorners<3>& at, const CellFrame<3>& frame)
  {
    Lanes a[4][3];
    for (int i = 0; i < 3; ++i) {
      // Differences along the edges come first: sums of places would lose digits.
      const auto& c = at.along[i];
      const Lanes x[4] = {c[1] - c[0], c[3] - c[2], c[5] - c[4], c[7] - c[6]};
      const Lanes lower = x[0] + x[1], upper = x[2] + x[3];
      const Lanes lower_turn = x[1] - x[0], upper_turn = x[3] - x[2];
      const Lanes y_lower = (c[2] - c[0]) + (c[3] - c[1]), y_upper = (c[6] - c[4]) + (c[7] - c[5]);
      const Lanes z = ((c[4] - c[0]) + (c[5] - c[1])) + ((c[6] - c[2]) + (c[7] - c[3]));
      f[i] = (lower + upper) * frame.quarter_inverse[0];
      f[i + 3] = (y_lower + y_upper) * frame.quarter_inverse[1];
      f[i + 6] = z * frame.quarter_inverse[2];
      a[0][i] = (y_upper - y_lower) * frame.share[0];
      a[1][i] = (upper - lower) * frame.share[1];
      a[2][i] = (lower_turn + upper_turn) * frame.share[2];
      a[3][i] = (upper_turn - lower_turn) * frame.share[3];
    }
    invert<3>(f, inverse);
    for (int m = 0; m < 4; ++m)
      for (int i = 0; i < 3; ++i)
        bending[3 * m + i] =
            inverse[i] * a[m][0] + inverse[i + 3] * a[m][1] + inverse[i + 6] * a[m][2];
  }
  Lanes jacobian() const { return determinant<3>(f); }
  /// A lower bound of what the edges span at a corner, of that at rest: J det(I + B), where B holds
  /// in column j the change along axis j by the modes, and det(I + B) >= (1 - |B|)^3.
  Lanes narrowest_corner(const CellFrame<3>& frame) const
  {
    Lanes squared = 0.0;
    for (int m = 0; m < 4; ++m) {
      const Lanes* b = bending + 3 * m;
      const Lanes of_mode = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
      // |B| of a mode is |b| times the root of the sum of the squares of the two edges in it, or of
      // the three products of two edges.
      const double x = frame.half[0] * frame.half[0], y = frame.half[1] * frame.half[1],
                   z = frame.half[2] * frame.half[2];
      const double radius =
          m < 3 ? frame.radius_squared - frame.half[m] * frame.half[m] : x * y + y * z + z * x;
      squared += 4 * radius * of_mode;  // (sum of four)^2 <= 4 sum of squares
    }
    const Lanes least = stdx::max(1.0 - stdx::sqrt(squared), Lanes(0.0));
    return jacobian() * least * least * least;
  }
  /// L = rate (F F_old^-1 - I), nine columns.
  [[gnu::always_inline]] void put_gradient(const double* old_columns, double rate,
                                           double* gradient) const
  {
    Lanes old[9], inverse[9];
    for (int k = 0; k < 9; ++k) old[k] = column(old_columns, k);
    invert<3>(old, inverse);
    for (int i = 0; i < 3; ++i) {
      const Lanes d[3] = {rate * (f[i] - old[i]), rate * (f[i + 3] - old[i + 3]),
                          rate * (f[i + 6] - old[i + 6])};
      for (int j = 0; j < 3; ++j)
        store(d[0] * inverse[3 * j] + d[1] * inverse[3 * j + 1] + d[2] * inverse[3 * j + 2],
              gradient + (i + 3 * j) * lane_count);
    }
  }
};

/// On the corners, from V0 tau {xx, yy, zz, xy, yz, xz} at the centre, J, and M^m = dW/db^m:
///   k^m = F^-T M^m ;  S = V0 tau F^-T - sum_m k^m (x) b^m ;
///   f_i = - S grad0 N_i - sum_m k^m e^m_i c_m
/// with the corners' signs e^m in mode m, and c_m their share of it. The gradient of W(F) + W(b).
[[gnu::always_inline]] inline CellCorners<3> corner_forces(const CellDeformation<3>& deformation,
                                                           const Lanes (&force_stress)[6],
                                                           const Lanes (&moment)[12],
                                                           const CellFrame<3>& frame)
{
  const Lanes(&inverse)[9] = deformation.inverse;
  const Lanes(&t)[6] = force_stress;
  const Lanes tau[3][3] = {{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}};
  const Lanes(&b)[12] = deformation.bending;
  CellCorners<3> force;
  for (int i = 0; i < 3; ++i) {
    Lanes k[4], s[3];
    for (int m = 0; m < 4; ++m)
      k[m] = inverse[3 * i] * moment[3 * m] + inverse[3 * i + 1] * moment[3 * m + 1] +
             inverse[3 * i + 2] * moment[3 * m + 2];
    for (int j = 0; j < 3; ++j) {
      s[j] = tau[i][0] * inverse[j] + tau[i][1] * inverse[j + 3] + tau[i][2] * inverse[j + 6];
      for (int m = 0; m < 4; ++m) s[j] -= k[m] * b[3 * m + j];
      s[j] *= frame.quarter_inverse[j];
    }
    for (int m = 0; m < 4; ++m) k[m] *= frame.share[m];
    // Corner by corner: signs of x, then of y, then of z, each on what does not hold it and does.
    const Lanes plain[2] = {-s[0], s[0]}, y[2] = {s[1] - k[2], s[1] + k[2]},
                z[2] = {s[2] - k[1], s[2] + k[1]}, yz[2] = {k[0] - k[3], k[0] + k[3]};
    for (int x = 0; x < 2; ++x) {
      const Lanes lower = plain[x] - y[x], upper = plain[x] + y[x];
      const Lanes turn_lower = z[x] - yz[x], turn_upper = z[x] + yz[x];
      force.along[i][x] = turn_lower - lower;
      force.along[i][x + 2] = turn_upper - upper;
      force.along[i][x + 4] = -lower - turn_lower;
      force.along[i][x + 6] = -upper - turn_upper;
    }
  }
  return force;
}

/// Squares of the principal stretches: eigenvalues of F^T F. Exact where they coincide too: roots
/// of a polynomial would lose half of the digits there, and other ranks take other steps.
inline Spectrum squared_stretches(const Lanes (&f)[9])
{
  const auto at = [&](int i, int j) {
    return f[3 * i] * f[3 * j] + f[3 * i + 1] * f[3 * j + 1] + f[3 * i + 2] * f[3 * j + 2];
  };
  return Spectrum({at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(0, 2)});
}
/// Of the middle.
inline Lanes least_stretch_squared(const CellDeformation<3>& now)
{
  return squared_stretches(now.f).least();
}
inline Lanes largest_stretch_squared(const Lanes (&f)[9])
{
  return squared_stretches(f).largest();
}

namespace brick_detail {

/// The edges at a corner, each towards the upper end of its axis, m.
struct CornerEdges {
  Lanes edge[9];  ///< component i of that along axis j at i + 3 j

  [[gnu::always_inline]] CornerEdges(const CellCorners<3>& at, int corner)
  {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        edge[i + 3 * j] = at.along[i][corner | 1 << j] - at.along[i][corner & ~(1 << j)];
  }
  /// What they span, of the volume at rest.
  [[gnu::always_inline]] Lanes share(const CellFrame<3>& frame) const
  {
    return determinant<3>(edge) * frame.inverse_volume();
  }
  [[gnu::always_inline]] Lanes gap(const CellFrame<3>& frame, const Lanes& least) const
  {
    return stdx::max(least - share(frame), Lanes(0.0));
  }
};

}  // namespace brick_detail

/// What the edges span at the narrowest corner, of the volume at rest.
inline Lanes narrowest_share(const CellCorners<3>& at, const CellFrame<3>& frame)
{
  Lanes least = brick_detail::CornerEdges(at, 0).share(frame);
  for (int corner = 1; corner < CellCorners<3>::count; ++corner)
    least = stdx::min(least, brick_detail::CornerEdges(at, corner).share(frame));
  return least;
}

/// As in the plane, with the volume that a corner's edges span.
inline Lanes corner_energy(const CellCorners<3>& at, const Lanes& stiffness,
                           const CellFrame<3>& frame, const Lanes& least = least_corner)
{
  Lanes energy = 0.0;
  for (int corner = 0; corner < CellCorners<3>::count; ++corner) {
    const Lanes gap = brick_detail::CornerEdges(at, corner).gap(frame, least);
    energy += 0.5 * stiffness * gap * gap;
  }
  return energy;
}

/// Adds minus its derivative.
inline void add_corner_forces(const CellCorners<3>& at, const Lanes& stiffness,
                              const CellFrame<3>& frame, CellCorners<3>& force,
                              const Lanes& least = least_corner)
{
  for (int corner = 0; corner < CellCorners<3>::count; ++corner) {
    const brick_detail::CornerEdges edges(at, corner);
    const Lanes push = stiffness * frame.inverse_volume() * edges.gap(frame, least);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const Lanes f = push * cofactor<3>(edges.edge, i, j);
        force.along[i][corner | 1 << j] += f;
        force.along[i][corner & ~(1 << j)] -= f;
      }
  }
}

}  // namespace mpm
