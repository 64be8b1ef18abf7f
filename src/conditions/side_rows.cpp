#include <mpm/conditions/side_rows.hpp>

namespace mpm {

#define MPM_SIDE(keyword) SideRow keyword##_side();
#include "sides.list"
#undef MPM_SIDE

template <>
std::span<const SideRow> list_of<SideRow>()
{
#define MPM_SIDE(keyword) keyword##_side(),
  static const SideRow rows[] = {
#include "sides.list"
  };
#undef MPM_SIDE
  return rows;
}

}  // namespace mpm
