#pragma once
#include <mpm/transfer/scheme.hpp>

namespace mpm {

/// PIC with an affine velocity field per particle, C = sum w v (x) (x_i - x_p) D^-1
/// (Jiang, Schroeder & Teran 2017, JCP 338:137).
struct Apic {
  static constexpr bool increments = false, affine = true, shape_gradient = false;
  static constexpr SchemeRow row{
      .keyword = "apic",
      .help = "the grid's velocity with an affine field from its moments",
      .words = "APIC",
      .book = ReactionBook::velocities,
      .affine = affine,
      .stable_cfl = &StableCfl::affine};
};

}  // namespace mpm
