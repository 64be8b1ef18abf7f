#include <mpm/conditions/side_rows.hpp>

namespace mpm {

SideRow free_side()
{
  return {.keyword = "free", .help = "nothing is there"};
}

}  // namespace mpm
