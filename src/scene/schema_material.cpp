// The keys of a material: its name, its law, and what the laws in the list ask for.
#include "kind_rows.hpp"

namespace mpm::scene {

template <>
const std::vector<Parameter<Material>>& parameters<Material>()
{
  static const std::vector<Parameter<Material>> rows = [] {
    std::vector<Parameter<Material>> list{
        member<Material>("law", &Material::law, {}, "how stress follows from strain"),
        member<Material>("name", &Material::name, {},
                         "for bands and shapes; needed with several materials")};
    add_kind_rows(list, "law", &Material::law);
    return list;
  }();
  return rows;
}

}  // namespace mpm::scene
