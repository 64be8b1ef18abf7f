#include <cmath>

#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// The elastic energy of a transversely isotropic law is positive for |nu_T| < 1 (the row's bound)
/// and nu_A^2 < E_A (1 - nu_T) / (2 E_T).
void check_axial_poisson_ratio(const Checked& checked, const Material& m, const std::string& path)
{
  const double limit = std::sqrt(m.axial_modulus * (1 - m.poisson_ratio) / (2 * m.youngs_modulus));
  if (std::abs(m.axial_poisson_ratio) >= limit)
    checked.refuse(path + ".axial_poisson_ratio",
                   fmt::format("must lie within +-{:.4g}, the square root of axial_modulus "
                               "(1 - poisson_ratio) / (2 youngs_modulus), or stretching would "
                               "release energy",
                               limit));
}

}  // namespace

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
    deformable = deformable || material.law != Law::rigid || !checked.sound(path + ".law");
    if (material.law == Law::transversely_isotropic && checked.sound(path))
      check_axial_poisson_ratio(checked, material, path);
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
  if (!deformable) {
    checked.refuse(checked.material_path(0) + ".law", "no material is left that can be deformed",
                   "Add one of another law");
  }
}

}  // namespace mpm::scene
