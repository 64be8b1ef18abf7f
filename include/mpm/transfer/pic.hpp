#pragma once
#include <mpm/transfer/scheme.hpp>

namespace mpm {

/// v_p = S v: interpolates, and damps strongly (Harlow 1964).
struct Pic {
  static constexpr bool increments = false, affine = false, shape_gradient = true;
  static constexpr SchemeRow row{.keyword = "pic",
                                 .help = "the grid's velocity; damps strongly",
                                 .words = "PIC",
                                 .book = ReactionBook::velocities,
                                 .affine = affine,
                                 .stable_cfl = &StableCfl::velocities};
};

}  // namespace mpm
