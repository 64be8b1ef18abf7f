#pragma once
#include <mpm/transfer/scheme.hpp>

namespace mpm {

/// v_p += dt S a: keeps every particle's own velocity (Brackbill & Ruppel 1986, J. Comput. Phys.
/// 65:314).
struct Flip {
  static constexpr bool increments = true, affine = false, shape_gradient = true;
  static constexpr SchemeRow row{.keyword = "flip",
                                 .help = "own velocity plus the grid's increment",
                                 .words = "FLIP",
                                 .book = ReactionBook::increments,
                                 .affine = affine,
                                 .stable_cfl = &StableCfl::increments};
};

}  // namespace mpm
