#pragma once
/// Transfer schemes: how particles learn from the grid, and what they tell it.

#include <mpm/core/types.hpp>
#include <mpm/particles/particle_store.hpp>

#include <vector>

namespace mpm {

/// v_p += dt S a: keeps every particle's own velocity (Brackbill & Ruppel 1986).
struct Flip {
  static constexpr bool increments = true, affine = false, shape_gradient = true;
};
/// v_p = S v: interpolates, and damps strongly.
struct Pic {
  static constexpr bool increments = false, affine = false, shape_gradient = true;
};
/// PIC with an affine velocity field per particle, C = sum w v (x) (x_i - x_p) D^-1
/// (Jiang, Schroeder & Teran 2017, JCP 338:137).
struct Apic {
  static constexpr bool increments = false, affine = true, shape_gradient = false;
};
/// PIC with the velocity gradient as affine field, C = sum v (x) g
/// (Nakamura, Matsumura & Mizutani 2023, CMAME 403:115720).
struct Tpic {
  static constexpr bool increments = false, affine = true, shape_gradient = true;
};

/// Where the motion columns of a particle lie. `grid_velocity` is there only for MUSL, whose
/// particles move in another pass than the one that reads the grid; the affine field only for
/// the schemes that have one.
template <int Dim, class Scheme>
struct MotionColumns {
  static constexpr int position = 0;
  static constexpr int velocity = Dim;
  static constexpr int mass = 2 * Dim;
  static constexpr int affine = 2 * Dim + 1;
  static constexpr int grid_velocity = affine + (Scheme::affine ? Dim * Dim : 0);

  static std::vector<Column> columns(bool musl)
  {
    std::vector<Column> list{{"position", Dim, "m"}, {"velocity", Dim, "m/s"}, {"mass", 1, "kg"}};
    if (Scheme::affine) list.push_back({"affine_velocity", Dim * Dim, "1/s"});
    if (musl) list.push_back({"grid_velocity", Dim, "m/s"});
    return list;
  }
};

}  // namespace mpm
