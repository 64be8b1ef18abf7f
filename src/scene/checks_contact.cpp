#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// The two names of an entry.
void check_names(const Checked& checked, const std::string& key,
                 const std::vector<std::string>& between)
{
  const bool of_cells = checked.scene.numerics.formulation == FormulationKind::total_lagrangian;
  if (between.size() != 2)
    return checked.refuse(key, "contact is between two bodies", "Name two materials");
  const std::vector<std::string> names = checked.material_names();
  if (names.empty()) return;
  const auto is_rigid = [&](auto name) {
    const auto index = std::size_t(name - names.begin());
    return index < checked.scene.materials.size() &&
           !checked.scene.materials[index].law->deformable();
  };
  for (std::size_t k = 0; k < between.size(); ++k) {
    const std::string path = fmt::format("{}[{}]", key, k);
    const auto found = std::ranges::find(names, between[k]);
    if (found == names.end())
      checked.refuse(path, "no material has this name", "Use " + alternatives(names));
    else if (is_rigid(found) && !of_cells)
      checked.refuse(path, "it is rigid: all bodies stick to it",
                     "Give it a law that can be deformed, or use formulation: total_lagrangian");
    else if (k == 1 && is_rigid(found) && is_rigid(std::ranges::find(names, between[0])))
      checked.refuse(path, "rigid bodies do not meet each other",
                     "Name a body that can be deformed");
    else if (k == 1 && between[0] == between[1] && !of_cells)
      checked.refuse(path, "a body moves in one velocity field and cannot touch itself",
                     "Name another material, or use formulation: total_lagrangian");
  }
}

bool same_pair(const BodyContact& a, const BodyContact& b)
{
  return std::ranges::is_permutation(a.between, b.between);
}

}  // namespace

void check_contact(const Checked& checked)
{
  const std::vector<BodyContact>& contacts = checked.scene.contacts;
  if (contacts.empty() || !checked.sound("contact")) return;
  const Numerics& numerics = checked.scene.numerics;
  if (numerics.formulation == FormulationKind::total_lagrangian) {
    if (contact_stiffness(numerics) == 0)
      checked.refuse("numerics.contact_stiffness", "bodies would go through each other",
                     "Leave it out");
    constexpr std::size_t most = 31;  // and a load cell
    if (checked.scene.materials.size() > most)
      checked.refuse("contact", fmt::format("of {} materials", checked.scene.materials.size()),
                     fmt::format("Use at most {}", most));
  } else if (numerics.scheme->refines)
    checked.refuse("numerics.scheme", "refined velocities would go through the contact again",
                   "Use scheme: flip");
  else if (!numerics.update_order->begins_with_force)
    checked.refuse("numerics.update_order", "stress would see velocities before contact acts",
                   "Use update_order: musl");
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::string key = fmt::format("contact[{}].between", i);
    if (!checked.sound(key)) continue;
    check_names(checked, key, contacts[i].between);
    for (std::size_t j = 0; j < i; ++j)
      if (same_pair(contacts[i], contacts[j]))
        checked.refuse(key, fmt::format("contact[{}] is between the same", j), "Remove one");
  }
}

}  // namespace mpm::scene
