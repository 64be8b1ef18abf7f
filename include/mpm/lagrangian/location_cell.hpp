#pragma once
/// A cell of the plane as large as a particle's location, integrated at its centre, with a mode of
/// bending for either axis: what a wall of one cell bends with.

#include <mpm/materials/law.hpp>

namespace mpm {

/// Places of corners, m, or forces on them, N. Bit 0 of the corner: upper along x, bit 1: along y.
struct Corners {
  Lanes x[4], y[4];
};

/// Of cells of one size at rest, m.
struct CellFrame {
  double half_inverse_x, half_inverse_y;  ///< 1 / (2 h), 1/m
  double inverse_area;                    ///< 1/m^2

  explicit CellFrame(const Vec<2>& size)
      : half_inverse_x(0.5 / size[0]),
        half_inverse_y(0.5 / size[1]),
        inverse_area(1 / (size[0] * size[1]))
  {
  }
};

/// Where the corners of a block of cells are, seen from its centre: x = x_c + F X + a X Y, with X
/// and Y along the edges at rest.
struct CellDeformation {
  Lanes f[4];  ///< F_ij at i + 2 j
  Lanes
      bending[2];  ///< b = F^-1 a, 1/m: fibres along axis j are strained by b_j times the distance

  [[gnu::always_inline]] CellDeformation(const Corners& at, const CellFrame& frame)
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
};

/// On the corners, from V0 tau {xx, yy, xy} at the centre, J, and the moments m_j = dW/db_j, J m:
///   k = F^-T m ;  S = V0 tau F^-T - k (x) b ;  f_i = - S grad0 N_i - k eps_i / (hx hy)
/// with eps = +, -, -, + the corners' signs in the mode X Y. The gradient of an energy W(F) + W(b).
[[gnu::always_inline]] inline Corners corner_forces(const CellDeformation& deformation,
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
  Corners force;
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

}  // namespace mpm
