#include <mpm/core/error.hpp>
#include <mpm/core/nearest_name.hpp>
#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/material_names.hpp>

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace mpm::micrograph {

MaterialNames::MaterialNames(const std::vector<scene::Material>& materials)
{
  constexpr std::size_t most = std::numeric_limits<std::int8_t>::max();
  if (materials.empty()) throw InputError("materials is empty. Describe at least one.");
  if (materials.size() > most)
    throw InputError(fmt::format("materials has {} entries. At most {} can be told apart.",
                                 materials.size(), most));
  for (const scene::Material& material : materials) names_.push_back(material.name);
}

std::int8_t MaterialNames::index(const std::string& name, std::string_view key) const
{
  if (name == "void") return Lattice<2>::empty;
  if (name.empty() && names_.size() == 1) return 0;
  if (name.empty())
    throw InputError(fmt::format("{} is missing. Name one of: {}.", key, fmt::join(names_, ", ")));
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end())
    throw InputError(
        fmt::format("{} is '{}', an unknown material ({}).", key, name, suggestion(name, names_)));
  return std::int8_t(found - names_.begin());
}

}  // namespace mpm::micrograph
