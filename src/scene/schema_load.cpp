// The keys of a load: its kind, and what the loads in the list ask for.
#include "kind_rows.hpp"

namespace mpm::scene {

template <>
const std::vector<Parameter<Load>>& parameters<Load>()
{
  static const std::vector<Parameter<Load>> rows = [] {
    std::vector<Parameter<Load>> list{
        member<Load>("kind", &Load::kind, {.need = Need::required}, "which load")};
    add_kind_rows(list, "kind", &Load::kind);
    return list;
  }();
  return rows;
}

}  // namespace mpm::scene
