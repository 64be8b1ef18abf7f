#include <mpm/transfer/musl_displacement.hpp>

#include <algorithm>

#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// The pair of sides of one axis in the list at `path`, the first of them at `first`.
void check_pair(const Checked& checked, const std::string& path, std::size_t first, Lateral lower,
                Lateral upper, int axis)
{
  const bool periodic = lower->periodic;
  if (periodic != upper->periodic)
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

/// Each side moves once at most, and is free otherwise.
void check_moving_sides(const Checked& checked, const FreeMotion& motion)
{
  for (std::size_t i = 0; i < motion.moving_sides.size(); ++i) {
    const Side side = motion.moving_sides[i].side;
    const std::string path = fmt::format("free_motion.moving_sides[{}]", i);
    const std::string key = path + ".side";
    if (!checked.sound(path)) continue;
    if (axis_of(side) >= checked.scene.dimensions)
      checked.refuse(key, "the scene lies in the plane", "Use left, right, bottom or top");
    else if (const SideRow& fixed = *motion.sides[std::size_t(side)]; !fixed.open())
      checked.refuse(key, "free_motion.sides makes it " + fixed.keyword, "Make it free there");
    for (std::size_t j = 0; j < i; ++j)
      if (motion.moving_sides[j].side == side)
        checked.refuse(key, fmt::format("moving_sides[{}] is the same side", j), "Remove one");
  }
}

/// Walls that push particles know no friction.
void check_friction_of_walls(const Checked& checked)
{
  const auto refuse = [&](const std::string& path, double friction) {
    if (friction > 0)
      checked.refuse(path, "particles slide on walls that push them",
                     "Leave it out, or use formulation: total_lagrangian");
  };
  if (const auto* loading = std::get_if<Loading>(&checked.scene.motion))
    return refuse("loading.friction", loading->friction);
  const auto& sides = std::get<FreeMotion>(checked.scene.motion).moving_sides;
  for (std::size_t i = 0; i < sides.size(); ++i)
    refuse(fmt::format("free_motion.moving_sides[{}].friction", i), sides[i].friction);
}

/// What walls that push particles need of the method.
void check_pushing_walls(const Checked& checked)
{
  const Numerics& numerics = checked.scene.numerics;
  const std::string stiffness = "numerics.contact_stiffness", order = "numerics.update_order";
  if (numerics.formulation == FormulationKind::total_lagrangian) return;
  check_friction_of_walls(checked);
  if (!walls_push(checked.scene))
    return checked.refuse(stiffness, "nothing is in contact",
                          "Leave it out, or use grip: contact or formulation: total_lagrangian");
  if (numerics.contact_stiffness == 0)
    checked.refuse(stiffness, "walls with grip: contact would hold nothing back", "Leave it out");
  if (numerics.scheme->refines)
    checked.refuse("numerics.scheme", "a wall with grip: contact does not know refined velocities",
                   "Use scheme: flip");
  // Else work is done on the wall that no strain has stored, and ringing grows at any step.
  if (numerics.update_order->keyword == MuslDisplacement::row.keyword) return;
  const std::string reason =
      "what a wall with grip: contact pushes must move by the velocities that its strain sees";
  const std::string remedy = fmt::format("update_order: {}", MuslDisplacement::row.keyword);
  if (checked.given(order))
    checked.refuse(order, reason, "Use " + remedy);
  else
    checked.miss(order, reason, "Add " + remedy);
}

}  // namespace

bool walls_push(const Scene& scene)
{
  if (const auto* loading = std::get_if<Loading>(&scene.motion))
    return loading->grip == Grip::contact;
  return std::ranges::any_of(std::get<FreeMotion>(scene.motion).moving_sides,
                             [](const MovingSide& side) { return side.grip == Grip::contact; });
}

double contact_stiffness(const Numerics& numerics)
{
  const bool of_bodies = numerics.formulation == FormulationKind::total_lagrangian;
  return numerics.contact_stiffness.value_or(of_bodies ? 2.0 : 0.5);
}

void check_sides(const Checked& checked)
{
  const int dimensions = checked.scene.dimensions;
  check_pushing_walls(checked);
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
    const auto& motion = std::get<FreeMotion>(checked.scene.motion);
    const auto& sides = motion.sides;
    check_moving_sides(checked, motion);
    for (int axis = 0; axis < dimensions; ++axis) {
      const auto at = std::size_t(2 * axis);
      check_pair(checked, "free_motion.sides", at, sides[at], sides[at + 1], axis);
    }
  }
}

}  // namespace mpm::scene
