#pragma once
/// Cells of the plane: a mode of bending for either axis.

#include <mpm/lagrangian/location_cell.hpp>

namespace mpm {

template <>
struct CellFrame<2> {
  double half_inverse_x, half_inverse_y;  ///< 1 / (2 h), 1/m
  double inverse_area;                    ///< 1/m^2
  double half_x, half_y;                  ///< m

  explicit CellFrame(const Vec<2>& size)
      : half_inverse_x(0.5 / size[0]),
        half_inverse_y(0.5 / size[1]),
        inverse_area(1 / (size[0] * size[1])),
        half_x(0.5 * size[0]),
        half_y(0.5 * size[1])
  {
  }
};

/// x = x_c + F X + a X Y, seen from the centre, with X and Y along the edges at rest.
template <>
struct CellDeformation<2> {
  static constexpr int modes = 2;

  Lanes f[4];  ///< F_ij at i + 2 j
  /// b = F^-1 a, 1/m: fibres along axis j are strained by b_j times the distance
  Lanes bending[modes];

  /// From columns of F and of what `keep` wrote.
  static constexpr int kept = modes;
  [[gnu::always_inline]] CellDeformation(const double* gradient, const double* columns)
  {
    for (int k = 0; k < 4; ++k) f[k] = column(gradient, k);
    for (int j = 0; j < modes; ++j) bending[j] = column(columns, j);
  }
  [[gnu::always_inline]] void keep(double* columns) const
  {
    for (int j = 0; j < modes; ++j) store(bending[j], columns + j * lane_count);
  }
  [[gnu::always_inline]] CellDeformation(const CellCorners<2>& at, const CellFrame<2>& frame)
  {
    Lanes twist[2];
    for (int i = 0; i < 2; ++i) {
      const auto& c = at.along[i];
      const Lanes below = c[1] - c[0], above = c[3] - c[2];
      f[i] = (below + above) * frame.half_inverse_x;
      f[i + 2] = ((c[2] - c[0]) + (c[3] - c[1])) * frame.half_inverse_y;
      twist[i] = (above - below) * frame.inverse_area;
    }
    const Lanes inverse = 1.0 / jacobian();
    bending[0] = (f[3] * twist[0] - f[2] * twist[1]) * inverse;
    bending[1] = (f[0] * twist[1] - f[1] * twist[0]) * inverse;
  }
  Lanes jacobian() const { return f[0] * f[3] - f[1] * f[2]; }
  /// What the edges span at the narrowest corner, of that at rest: at X, Y the determinant is
  /// J (1 + b_1 Y + b_2 X).
  Lanes narrowest_corner(const CellFrame<2>& frame) const
  {
    return jacobian() *
           (1.0 - stdx::abs(bending[0]) * frame.half_y - stdx::abs(bending[1]) * frame.half_x);
  }
  /// L = rate (F F_old^-1 - I), four columns.
  [[gnu::always_inline]] void put_gradient(const double* old_columns, double rate,
                                           double* gradient) const
  {
    const Lanes old[4] = {column(old_columns, 0), column(old_columns, 1), column(old_columns, 2),
                          column(old_columns, 3)};
    const Lanes per_step = rate / (old[0] * old[3] - old[1] * old[2]);
    for (int i = 0; i < 2; ++i) {
      const Lanes dx = (f[i] - old[i]) * per_step, dy = (f[i + 2] - old[i + 2]) * per_step;
      store(dx * old[3] - dy * old[1], gradient + i * lane_count);
      store(dy * old[0] - dx * old[2], gradient + (i + 2) * lane_count);
    }
  }
};

/// Moments m_j = dW/db_j of fibres along the axes. Each bends by itself.
template <>
class CellBending<2> {
 public:
  static constexpr int modes = CellDeformation<2>::modes;

  CellBending(const BendingModuli<2>& moduli, const Vec<2>& size)
  {
    for (int axis = 0; axis < 2; ++axis) {
      const double thickness = size[1 - axis], modulus = moduli.fibres[axis];
      fibre_stress_[axis] = modulus * thickness / 3;
      compliance_[axis] = modulus > 0 ? 1 / fibre_stress_[axis] : 0;
      bending_[axis] = modulus * thickness * thickness / 12;
    }
  }
  static Column rest_column() { return {"rest_bending", modes, "1/m"}; }

  /// For the law, as in bending.hpp. `rest`: columns of the bending without moments, which is what
  /// the cell had at rest and what is plastic since; or null where that stays 0.
  [[gnu::always_inline]] void put_trial(const CellDeformation<2>& now, const double* rest,
                                        double* columns) const
  {
    for (int j = 0; j < modes; ++j)
      store(fibre_stress_[j] * elastic(now.bending, rest, j), columns + j * lane_count);
    for (int k = 0; k < 4; ++k) store(now.f[k], columns + (modes + k) * lane_count);
  }
  /// Once the law has put what flow takes in place of the stresses: moments, J m, and what becomes
  /// plastic.
  [[gnu::always_inline]] void moments(const Lanes (&bent)[modes], const double* columns,
                                      const Lanes& volume, double* rest,
                                      Lanes (&moment)[modes]) const
  {
    for (int j = 0; j < modes; ++j) {
      Lanes left = elastic(bent, rest, j);
      if (rest) {
        const Lanes lost = compliance_[j] * column(columns, j);
        double* of_mode = rest + j * lane_count;
        store(load(of_mode) + lost, of_mode);
        left -= lost;
      }
      moment[j] = bending_[j] * volume * left;
    }
  }
  /// J
  void add_energy(const Lanes (&bent)[modes], const double* rest, const Lanes& volume,
                  Lanes& sum) const
  {
    for (int j = 0; j < modes; ++j) {
      const Lanes stored = elastic(bent, rest, j);
      sum += 0.5 * bending_[j] * volume * stored * stored;
    }
  }

 private:
  [[gnu::always_inline]] static Lanes elastic(const Lanes (&bent)[modes], const double* rest,
                                              int mode)
  {
    return rest ? bent[mode] - column(rest, mode) : bent[mode];
  }

  Vec<2> fibre_stress_;  ///< Pa m: (m / (V0 h / 4)) over the elastic bending
  Vec<2> compliance_;    ///< 1/(Pa m): of fibre_stress_
  Vec<2> bending_;       ///< Pa m^2: m / V0 over the elastic bending
};

/// On the corners, from V0 tau {xx, yy, xy} at the centre, J, and the moments m_j = dW/db_j, J m:
///   k = F^-T m ;  S = V0 tau F^-T - k (x) b ;  f_i = - S grad0 N_i - k eps_i / (hx hy)
/// with eps = +, -, -, + the corners' signs in the mode X Y. The gradient of an energy W(F) + W(b).
[[gnu::always_inline]] inline CellCorners<2> corner_forces(const CellDeformation<2>& deformation,
                                                           const Lanes (&force_stress)[3],
                                                           const Lanes (&moment)[2],
                                                           const CellFrame<2>& frame)
{
  const Lanes(&f)[4] = deformation.f;
  const Lanes inverse = 1.0 / deformation.jacobian();
  // F^-T_ij at i + 2 j
  const Lanes g[4] = {f[3] * inverse, -f[2] * inverse, -f[1] * inverse, f[0] * inverse};
  const Lanes k[2] = {g[0] * moment[0] + g[2] * moment[1], g[1] * moment[0] + g[3] * moment[1]};
  const Lanes tau[2][2] = {{force_stress[0], force_stress[2]}, {force_stress[2], force_stress[1]}};
  CellCorners<2> force;
  for (int i = 0; i < 2; ++i) {
    const Lanes along_x = tau[i][0] * g[0] + tau[i][1] * g[1] - k[i] * deformation.bending[0];
    const Lanes along_y = tau[i][0] * g[2] + tau[i][1] * g[3] - k[i] * deformation.bending[1];
    const Lanes sx = along_x * frame.half_inverse_x, sy = along_y * frame.half_inverse_y;
    const Lanes mode = k[i] * frame.inverse_area;
    Lanes(&out)[4] = force.along[i];
    out[0] = sx + sy - mode;
    out[1] = sy - sx + mode;
    out[2] = sx - sy + mode;
    out[3] = -sx - sy - mode;
  }
  return force;
}

/// Squares of the stretches of the middle, the least one.
[[gnu::always_inline]] inline Lanes least_stretch_squared(const CellDeformation<2>& now)
{
  const Lanes(&f)[4] = now.f;
  const Lanes a = f[0] * f[0] + f[1] * f[1], b = f[2] * f[2] + f[3] * f[3],
              c = f[0] * f[2] + f[1] * f[3];
  const Lanes half = 0.5 * (a - b);
  const Lanes jacobian = now.jacobian();
  // J^2 over the square of the larger one: the difference of the two would lose digits.
  return jacobian * jacobian / (0.5 * (a + b) + stdx::sqrt(half * half + c * c));
}

/// Square of the largest stretch of F, its columns one after the other.
inline Lanes largest_stretch_squared(const Lanes (&f)[4])
{
  const Lanes a = f[0] * f[0] + f[1] * f[1], b = f[2] * f[2] + f[3] * f[3],
              c = f[0] * f[2] + f[1] * f[3];
  const Lanes half = 0.5 * (a - b);
  return 0.5 * (a + b) + stdx::sqrt(half * half + c * c);
}

namespace plane_cell_detail {

/// Of corner k: the next ones along the boundary, counter-clockwise and clockwise.
inline constexpr int next[4] = {1, 3, 0, 2}, last[4] = {2, 0, 3, 1};

struct CornerEdges {
  Lanes ux, uy, wx, wy;  ///< to the next corner and to the last, m

  [[gnu::always_inline]] CornerEdges(const CellCorners<2>& at, int k)
      : ux(at.along[0][next[k]] - at.along[0][k]),
        uy(at.along[1][next[k]] - at.along[1][k]),
        wx(at.along[0][last[k]] - at.along[0][k]),
        wy(at.along[1][last[k]] - at.along[1][k])
  {
  }
  /// By how much they span too little, of the area at rest.
  [[gnu::always_inline]] Lanes gap(const CellFrame<2>& frame, const Lanes& least) const
  {
    return stdx::max(least - (ux * wy - uy * wx) * frame.inverse_area, Lanes(0.0));
  }
};

}  // namespace plane_cell_detail

/// sum over the corners of stiffness (least - a)^2 / 2, a = span of the corner's edges over that of
/// a location; `least` is least_corner of that of the narrowest corner at rest, so that it is 0 for
/// every affine deformation by J > least_corner. One-point cells without it tangle where they are
/// pressed from all sides. `stiffness`, J.
[[gnu::always_inline]] inline Lanes corner_energy(const CellCorners<2>& at, const Lanes& stiffness,
                                                  const CellFrame<2>& frame,
                                                  const Lanes& least = least_corner)
{
  Lanes energy = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Lanes gap = plane_cell_detail::CornerEdges(at, k).gap(frame, least);
    energy += 0.5 * stiffness * gap * gap;
  }
  return energy;
}

/// Adds minus its derivative.
[[gnu::always_inline]] inline void add_corner_forces(const CellCorners<2>& at,
                                                     const Lanes& stiffness,
                                                     const CellFrame<2>& frame,
                                                     CellCorners<2>& force,
                                                     const Lanes& least = least_corner)
{
  using namespace plane_cell_detail;
  for (int k = 0; k < 4; ++k) {
    const CornerEdges edges(at, k);
    const Lanes push = stiffness * frame.inverse_area * edges.gap(frame, least);
    const int p = next[k], q = last[k];
    force.along[0][p] += push * edges.wy;
    force.along[1][p] -= push * edges.wx;
    force.along[0][q] -= push * edges.uy;
    force.along[1][q] += push * edges.ux;
    force.along[0][k] -= push * (edges.wy - edges.uy);
    force.along[1][k] -= push * (edges.ux - edges.wx);
  }
}

}  // namespace mpm
