#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

bool has_plastic_strain(const Material& material, Plane plane)
{
  const LawRow& law = *material.law;
  ParameterValues values = material.values;
  fill_defaults(law, values);
  const std::vector<Column> columns = law.in_plane ? law.in_plane(values, plane)->state_columns()
                                                   : law.in_space(values)->state_columns();
  return std::ranges::find(columns, "plastic_strain", &Column::name) != columns.end();
}

/// Laws that are not there in the plane, or not in space.
void check_law(const Checked& checked, const LawRow& law, const std::string& key)
{
  const int dimensions = checked.scene.dimensions;
  if (!law.deformable() || law.is_there(dimensions) || !checked.sound(key)) return;
  checked.refuse(key,
                 fmt::format("it is there in {} only", dimensions == 3 ? "the plane" : "space"),
                 "Use " + alternatives(laws_there(dimensions)));
}

void check_failure(const Checked& checked, const Material& material, const std::string& path)
{
  const std::string key = path + ".failure";
  if (!checked.given(key) || !checked.sound(path)) return;
  const Numerics& numerics = checked.scene.numerics;
  if (numerics.formulation != FormulationKind::total_lagrangian)
    return checked.refuse(key, "only cells of total_lagrangian fail",
                          "Leave it out, or set numerics.formulation: total_lagrangian");
  if (!material.law->deformable())
    return checked.refuse(key, "a rigid body bears anything", "Leave it out");
  const Failure failure = material.failure.value_or(Failure{});
  if (!failure.plastic_strain && !failure.stretch)
    return checked.refuse(key, "it sets no limit", "Add plastic_strain: 1.5 or stretch: 4");
  if (failure.plastic_strain && !has_plastic_strain(material, numerics.plane))
    checked.refuse(key + ".plastic_strain",
                   fmt::format("law {} has no plastic strain", material.law->keyword),
                   "Use stretch, or a law that flows, such as von_mises");
}

}  // namespace

void check_materials(const Checked& checked)
{
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
    check_law(checked, *material.law, path + ".law");
    check_failure(checked, material, path);
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
  else if (first != materials.end() && loading && loading->load_cell &&
           !(first->values.number("poisson_ratio") < 0.5))
    checked.refuse(
        "loading.load_cell",
        "it is made from Young's modulus and Poisson's ratio of the first material as an "
        "isotropic solid, which has less than 0.5",
        "Leave it out, or name another material first");
  if (!deformable) {
    checked.refuse(checked.material_path(0) + ".law", "no material is left that can be deformed",
                   "Add one of another law");
  }
}

}  // namespace mpm::scene
