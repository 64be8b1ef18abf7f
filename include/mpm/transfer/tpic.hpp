#pragma once
#include <mpm/transfer/scheme.hpp>

namespace mpm {

/// PIC with the velocity gradient as affine field, C = sum v (x) g
/// (Nakamura, Matsumura & Mizutani 2023, CMAME 403:115720).
struct Tpic {
  static constexpr bool increments = false, affine = true, shape_gradient = true;
  static constexpr SchemeRow row{.keyword = "tpic",
                                 .help = "the grid's velocity with its gradient as affine field",
                                 .words = "TPIC",
                                 .book = ReactionBook::velocities,
                                 .affine = affine,
                                 .stable_cfl = &StableCfl::affine};
};

}  // namespace mpm
