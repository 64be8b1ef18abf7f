#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// The pair of sides of one axis in the list at `path`, the first of them at `first`.
void check_pair(const Checked& checked, const std::string& path, std::size_t first, Lateral lower,
                Lateral upper, int axis)
{
  const bool periodic = lower == Lateral::periodic;
  if (periodic != (upper == Lateral::periodic))
    checked.refuse(
        path, fmt::format("along {} one side is periodic and the other is not", "xyz"[axis]),
        fmt::format("Make entries {} and {} both periodic, or neither", first + 1, first + 2));
  const auto& margin = checked.scene.grid.margin;
  const auto side = std::size_t(2 * axis);
  if (periodic && (margin[side] > 0 || margin[side + 1] > 0))
    checked.refuse("grid.margin",
                   fmt::format("the sides along {} are periodic: what leaves through one comes in "
                               "through the other at once",
                               "xyz"[axis]),
                   "Leave no margin there");
}

}  // namespace

void check_sides(const Checked& checked)
{
  const int dimensions = checked.scene.dimensions;
  if (const auto* loading = std::get_if<Loading>(&checked.scene.motion)) {
    if (axis_of(loading->piston) >= dimensions)
      checked.refuse("loading.piston", "the scene lies in the plane",
                     "Use left, right, bottom or top");
    else if (checked.sound("loading.lateral") && checked.sound("loading.piston"))
      for (int axis = 0, first = 0; axis < dimensions; ++axis) {
        if (axis == axis_of(loading->piston)) continue;
        const auto& lateral = loading->lateral;
        const auto at = std::size_t(first);
        check_pair(checked, "loading.lateral", at, lateral[at], lateral[at + 1], axis);
        first += 2;
      }
  } else if (checked.sound("free_motion.sides")) {
    const auto& sides = std::get<FreeMotion>(checked.scene.motion).sides;
    for (int axis = 0; axis < dimensions; ++axis) {
      const auto at = std::size_t(2 * axis);
      check_pair(checked, "free_motion.sides", at, sides[at], sides[at + 1], axis);
    }
  }
}

}  // namespace mpm::scene
