#include <mpm/conditions/side_rows.hpp>

namespace mpm {

SideRow periodic_side()
{
  return {.keyword = "periodic",
          .help = "what leaves through it comes in through the side opposite, which is so too",
          .periodic = true};
}

}  // namespace mpm
