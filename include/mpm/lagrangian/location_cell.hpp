#pragma once
/// A cell of the plane as large as a particle's location, integrated at its centre, with a mode of
/// bending for either axis: what a wall of one cell bends with.

#include <mpm/materials/law.hpp>

namespace mpm {

/// Places of corners, m, or forces on them, N. Bit 0 of the corner: upper along x, bit 1: along y.
struct CellCorners {
  Lanes x[4], y[4];
};

/// Of cells of one size at rest, m.
struct CellFrame {
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

/// Where the corners of a block of cells are, seen from its centre: x = x_c + F X + a X Y, with X
/// and Y along the edges at rest.
struct CellDeformation {
  Lanes f[4];  ///< F_ij at i + 2 j
  Lanes
      bending[2];  ///< b = F^-1 a, 1/m: fibres along axis j are strained by b_j times the distance

  CellDeformation() = default;
  [[gnu::always_inline]] CellDeformation(const CellCorners& at, const CellFrame& frame)
  {
    const Lanes(*const place[2])[4] = {&at.x, &at.y};
    Lanes twist[2];
    for (int i = 0; i < 2; ++i) {
      const auto& c = *place[i];
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
  Lanes narrowest_corner(const CellFrame& frame) const
  {
    return jacobian() *
           (1.0 - stdx::abs(bending[0]) * frame.half_y - stdx::abs(bending[1]) * frame.half_x);
  }
};

/// On the corners, from V0 tau {xx, yy, xy} at the centre, J, and the moments m_j = dW/db_j, J m:
///   k = F^-T m ;  S = V0 tau F^-T - k (x) b ;  f_i = - S grad0 N_i - k eps_i / (hx hy)
/// with eps = +, -, -, + the corners' signs in the mode X Y. The gradient of an energy W(F) + W(b).
[[gnu::always_inline]] inline CellCorners corner_forces(const CellDeformation& deformation,
                                                        const Lanes (&force_stress)[3],
                                                        const Lanes (&moment)[2],
                                                        const CellFrame& frame)
{
  const Lanes(&f)[4] = deformation.f;
  const Lanes inverse = 1.0 / deformation.jacobian();
  // F^-T_ij at i + 2 j
  const Lanes g[4] = {f[3] * inverse, -f[2] * inverse, -f[1] * inverse, f[0] * inverse};
  const Lanes k[2] = {g[0] * moment[0] + g[2] * moment[1], g[1] * moment[0] + g[3] * moment[1]};
  const Lanes tau[2][2] = {{force_stress[0], force_stress[2]}, {force_stress[2], force_stress[1]}};
  CellCorners force;
  for (int i = 0; i < 2; ++i) {
    const Lanes along_x = tau[i][0] * g[0] + tau[i][1] * g[1] - k[i] * deformation.bending[0];
    const Lanes along_y = tau[i][0] * g[2] + tau[i][1] * g[3] - k[i] * deformation.bending[1];
    const Lanes sx = along_x * frame.half_inverse_x, sy = along_y * frame.half_inverse_y;
    const Lanes mode = k[i] * frame.inverse_area;
    Lanes(&out)[4] = i == 0 ? force.x : force.y;
    out[0] = sx + sy - mode;
    out[1] = sy - sx + mode;
    out[2] = sx - sy + mode;
    out[3] = -sx - sy - mode;
  }
  return force;
}

/// A cell's corner whose edges span less than this of their area at rest is held open.
inline constexpr double least_corner = 0.2;

namespace location_cell_detail {

/// Of corner k: the next ones along the boundary, counter-clockwise and clockwise.
inline constexpr int next[4] = {1, 3, 0, 2}, last[4] = {2, 0, 3, 1};

struct CornerEdges {
  Lanes ux, uy, wx, wy;  ///< to the next corner and to the last, m

  [[gnu::always_inline]] CornerEdges(const CellCorners& at, int k)
      : ux(at.x[next[k]] - at.x[k]),
        uy(at.y[next[k]] - at.y[k]),
        wx(at.x[last[k]] - at.x[k]),
        wy(at.y[last[k]] - at.y[k])
  {
  }
  /// By how much they span too little, of the area at rest.
  [[gnu::always_inline]] Lanes gap(const CellFrame& frame) const
  {
    return stdx::max(least_corner - (ux * wy - uy * wx) * frame.inverse_area, Lanes(0.0));
  }
};

}  // namespace location_cell_detail

/// sum over the corners of stiffness (least_corner - a)^2 / 2, a = span of the corner's edges over
/// that at rest: 0 for every affine deformation with J > least_corner. One-point cells without it
/// tangle where they are pressed from all sides. `stiffness`, J.
[[gnu::always_inline]] inline Lanes corner_energy(const CellCorners& at, const Lanes& stiffness,
                                                  const CellFrame& frame)
{
  Lanes energy = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Lanes gap = location_cell_detail::CornerEdges(at, k).gap(frame);
    energy += 0.5 * stiffness * gap * gap;
  }
  return energy;
}

/// Adds minus its derivative.
[[gnu::always_inline]] inline void add_corner_forces(const CellCorners& at, const Lanes& stiffness,
                                                     const CellFrame& frame, CellCorners& force)
{
  using namespace location_cell_detail;
  for (int k = 0; k < 4; ++k) {
    const CornerEdges edges(at, k);
    const Lanes push = stiffness * frame.inverse_area * edges.gap(frame);
    const int p = next[k], q = last[k];
    force.x[p] += push * edges.wy;
    force.y[p] -= push * edges.wx;
    force.x[q] -= push * edges.uy;
    force.y[q] += push * edges.ux;
    force.x[k] -= push * (edges.wy - edges.uy);
    force.y[k] -= push * (edges.ux - edges.wx);
  }
}

}  // namespace mpm
