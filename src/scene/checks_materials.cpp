#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

void check_materials(const Checked& checked)
{
  checked.both_given("materials", "material");
  const std::vector<Material>& materials = checked.scene.materials;
  if (checked.given("material") && checked.given("materials")) return;
  if (materials.empty() && checked.given("materials")) {
    checked.refuse("materials", "a specimen is made of at least one");
    return;
  }

  bool deformable = materials.empty();
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Material& material = materials[i];
    const std::string path = checked.material_path(i);
    deformable = deformable || material.law->deformable() || !checked.sound(path + ".law");
    if (material.law->check && checked.sound(path))
      if (const auto found = material.law->check(material.values))
        checked.refuse(path + "." + found->key, found->reason);
    if (material.name == "void" || material.name.empty())
      checked.refuse(path + ".name", "stands for no material", "Choose another name");
    if (materials.size() > 1 && !checked.given(path + ".name")) {
      checked.miss(path + ".name", "several materials are told apart by name",
                   "Add e.g. name: cell_wall");
      continue;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (materials[j].name == material.name && checked.given(checked.material_path(j) + ".name"))
        checked.refuse(path + ".name", fmt::format("materials[{}] has this name already", j),
                       "Choose another name");
    }
  }
  const auto first = std::ranges::find_if(
      materials, [](const Material& material) { return material.law->deformable(); });
  const auto* loading = std::get_if<Loading>(&checked.scene.motion);
  if (first != materials.end() && loading && loading->load_cell &&
      !(first->law->has("youngs_modulus") && first->law->has("poisson_ratio")))
    checked.refuse("loading.load_cell",
                   "it is made from Young's modulus and Poisson's ratio of the first material, "
                   "which law " +
                       first->law->keyword + " does not have");
  if (!deformable) {
    checked.refuse(checked.material_path(0) + ".law", "no material is left that can be deformed",
                   "Add one of another law");
  }
}

}  // namespace mpm::scene
