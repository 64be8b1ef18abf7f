#include "checks.hpp"
#include <fmt/format.h>

namespace mpm::scene {

void check_loads(const Checked& checked)
{
  for (std::size_t i = 0; i < checked.scene.loads.size(); ++i) {
    const Load& load = checked.scene.loads[i];
    const std::string path = fmt::format("loads[{}]", i);
    if (!load.kind->check || !checked.sound(path)) continue;
    if (const auto found = load.kind->check(load.values, checked.scene.dimensions))
      checked.refuse(path + "." + found->key, found->reason);
  }
}

}  // namespace mpm::scene
