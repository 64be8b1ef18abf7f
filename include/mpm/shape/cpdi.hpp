#pragma once
#include <mpm/core/lane_matrix.hpp>
#include <mpm/shape/shape_row.hpp>

namespace mpm {

/// Convected particle domain interpolation (CPDI1; Sadeghirad, Brannon & Burghardt 2011, IJNME
/// 86:1435): hat functions N at the corners of a parallelogram, in space a parallelepiped, that
/// deforms with its particle. With the half axes r_k, the corners x_c = x_p + sum_k s_ck r_k,
/// s_ck = -1 or 1, and R = (r_1, r_2, ...):
///   w_i = 2^-Dim sum_c N_i(x_c),   grad w_i = 2^-Dim R^-T sum_c s_c N_i(x_c).
struct Cpdi {
  /// Limits of a bar pressed to half its length, the smallest ones (at rest 1.73 with FLIP). Those
  /// of affine schemes are what crushed wood bears: the bar 0.9 at rest, and 0.69 at half its
  /// length.
  static constexpr ShapeRow row{.keyword = "cpdi",
                                .help = "CPDI (particle domains that deform)",
                                .words = "CPDI",
                                .stable_cfl = {.increments = 1.65,
                                               .velocities = 1.4,
                                               .affine = 0.9,
                                               .refined = 0.88,
                                               .stress_last = 0.5},
                                .cfl_share = 0.7,
                                .step_cost = 115};
  static Cpdi make(double domain) { return {0.5 * domain}; }

  static constexpr bool carries_domain = true;
  static constexpr bool ends_at_walls = false;
  static constexpr int support = 4;
  static constexpr double base_shift() { return 1.0; }
  template <int Dim>
  static constexpr int nodes = Dim == 3 ? 64 : 16;

  /// Cells: how far a corner may be from its particle along each axis.
  static constexpr double farthest_corner = 1.0;
  /// Of a particle at rest: what the reach of a domain along an axis does not fall below. As
  /// domains go to nothing the weights go to hat functions, for which affine schemes and USL have
  /// no stable step at free edges.
  static constexpr double smallest_reach = 0.5;
  /// Of det R in cells: below it, or inverted, the domain counts as the box of a particle at rest.
  static constexpr double smallest_volume = 1e-9;

  double half_size;  ///< of a particle at rest, in cells

  /// `axes`: component d of r_k at d + Dim * k, in cells of axis d. Shortens along each axis by
  /// itself what reaches too far (a limit in the spirit of Homel, Brannon & Guilkey 2016, IJNME
  /// 109:1013), so that a domain that is long in one direction keeps its width in the others, and
  /// lengthens what reaches not far enough.
  template <int Dim>
  [[gnu::always_inline]] void limit(Lanes (&axes)[Dim * Dim]) const
  {
    for (int d = 0; d < Dim; ++d) {
      Lanes reach = 1e-30;  // a domain without any is mended below
      for (int k = 0; k < Dim; ++k) reach += stdx::abs(axes[d + Dim * k]);
      const Lanes seen =
          stdx::min(stdx::max(reach, Lanes(smallest_reach * half_size)), Lanes(farthest_corner));
      const Lanes share = seen / reach;
      for (int k = 0; k < Dim; ++k) axes[d + Dim * k] *= share;
    }
    const LaneMask sound = determinant<Dim>(axes) > smallest_volume;
    for (int k = 0; k < Dim; ++k)
      for (int d = 0; d < Dim; ++d)
        stdx::where(!sound, axes[d + Dim * k]) = d == k ? half_size : 0.0;
  }

  /// r: the particle's place from the first node, in cells; `axes` as `limit` leaves them. Fills
  /// weight[node] and, times `scale` per axis, gradient[d][node], nodes with x fastest.
  template <int Dim>
  [[gnu::always_inline]] static void weights(const Lanes (&r)[Dim], const Lanes (&axes)[Dim * Dim],
                                             const double (&scale)[Dim],
                                             double (&weight)[nodes<Dim>][lane_count],
                                             double (&gradient)[Dim][nodes<Dim>][lane_count])
  {
    constexpr int corners = 1 << Dim, layers = Dim == 3 ? support : 1;
    constexpr double share = 1.0 / corners;
    Lanes hat[Dim][corners][support];
    for (int c = 0; c < corners; ++c)
      for (int d = 0; d < Dim; ++d) {
        Lanes x = r[d];
        for (int k = 0; k < Dim; ++k) x += sign(c, k) * axes[d + Dim * k];
        for (int a = 0; a < support; ++a)
          hat[d][c][a] = stdx::max(1.0 - stdx::abs(x - double(a)), Lanes(0.0));
      }
    Lanes inverse[Dim * Dim];  // R^-1: row k, column d at k + Dim * d
    invert<Dim>(axes, inverse);
    for (int d = 0; d < Dim; ++d)
      for (int k = 0; k < Dim; ++k) inverse[k + Dim * d] *= share * scale[d];

    for (int row = 0; row < layers * support; ++row) {
      Lanes across[corners];
      for (int c = 0; c < corners; ++c) {
        across[c] = hat[1][c][row % support];
        if constexpr (Dim == 3) across[c] *= hat[2][c][row / support];
      }
      for (int a = 0; a < support; ++a) {
        const int node = row * support + a;
        Lanes value[corners], difference[Dim];  // sum_c s_ck N(x_c)
        for (int c = 0; c < corners; ++c) value[c] = hat[0][c][a] * across[c];
        difference[0] = fold<corners / 2>(value);
        difference[1] = fold<corners / 4>(value);
        if constexpr (Dim == 3) difference[2] = fold<1>(value);
        store(share * value[0], weight[node]);
        for (int d = 0; d < Dim; ++d) {
          Lanes slope = inverse[Dim * d] * difference[0];
          for (int k = 1; k < Dim; ++k) slope += inverse[k + Dim * d] * difference[k];
          store(slope, gradient[d][node]);
        }
      }
    }
  }

 private:
  /// Values of 2 Count corners, which lie below and above by turns along an axis: leaves their sums
  /// over this axis, and returns the sum of the differences.
  template <int Count>
  [[gnu::always_inline]] static Lanes fold(Lanes* value)
  {
    Lanes difference = 0.0;
    for (int k = 0; k < Count; ++k) {
      const Lanes below = value[2 * k], above = value[2 * k + 1];
      difference += above - below;
      value[k] = below + above;
    }
    return difference;
  }
  static constexpr double sign(int corner, int axis) { return corner >> axis & 1 ? 1.0 : -1.0; }
};

}  // namespace mpm
