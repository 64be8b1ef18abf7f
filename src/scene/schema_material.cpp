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
                         "for bands and shapes; needed with several materials"),
        member<Material>("failure", &Material::failure, {.default_text = "none: nothing fails"},
                         "where cells of total_lagrangian fail and are removed")};
    add_kind_rows(list, "law", &Material::law);
    return list;
  }();
  return rows;
}

template <>
const std::vector<Parameter<Failure>>& parameters<Failure>()
{
  static const std::vector<Parameter<Failure>> rows{
      member<Failure>("plastic_strain", &Failure::plastic_strain,
                      {.bound = above(0), .default_text = "none"},
                      "equivalent plastic strain at which a cell fails, of laws that flow"),
      member<Failure>("stretch", &Failure::stretch, {.bound = above(1), .default_text = "none"},
                      "largest principal stretch at which a cell fails"),
  };
  return rows;
}

}  // namespace mpm::scene
