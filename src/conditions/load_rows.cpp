#include <mpm/conditions/load_rows.hpp>

namespace mpm {

#define MPM_LOAD(keyword) LoadRow keyword##_load();
#include "loads.list"
#undef MPM_LOAD

template <>
std::span<const LoadRow> list_of<LoadRow>()
{
#define MPM_LOAD(keyword) keyword##_load(),
  static const LoadRow rows[] = {
#include "loads.list"
  };
#undef MPM_LOAD
  return rows;
}

}  // namespace mpm
