#pragma once
#include <mpm/transfer/scheme.hpp>

namespace mpm {

/// v_p = S v*, where v* comes nearer to the velocity of the full mass matrix in each of
/// `numerics.refinement_order` - 1 refinements: PIC without most of its damping, and without the
/// noise that FLIP keeps (Nairn & Hammerquist 2021, CMAME 386:114138; the order 1 is PIC).
struct Fmpm {
  static constexpr bool increments = false, affine = false, shape_gradient = true;
  static constexpr SchemeRow row{.keyword = "fmpm",
                                 .help = "the grid's velocity by a better mass matrix",
                                 .words = "FMPM",
                                 .book = ReactionBook::velocities,
                                 .affine = affine,
                                 .stable_cfl = &StableCfl::refined,
                                 .refines = true};
};

}  // namespace mpm
