#pragma once
#include <mpm/transfer/scheme.hpp>

namespace mpm {

/// v_p += dt S a - (1 - S S+)^m v_p: FLIP without what m filters leave of the velocities that the
/// grid does not see, m = `numerics.refinement_order` (Hammerquist & Nairn 2017, CMAME 318:724;
/// the order 1 is PIC). The refinement of FMPM, of the velocity before the forces. The stable step
/// lies between those of PIC and FLIP.
struct Xpic {
  static constexpr bool increments = false, affine = false, shape_gradient = true;
  static constexpr SchemeRow row{.keyword = "xpic",
                                 .help = "own velocity, filtered, plus the grid's increment",
                                 .words = "XPIC",
                                 .book = ReactionBook::velocities,
                                 .affine = affine,
                                 .stable_cfl = &StableCfl::velocities,
                                 .refines = true,
                                 .refines_before_forces = true};
};

}  // namespace mpm
