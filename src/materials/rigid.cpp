#include <mpm/materials/laws.hpp>

namespace mpm {

/// No stress: conditions/rigid_body moves it.
LawRow rigid_law()
{
  return {.keyword = "rigid",
          .help = "cannot be deformed; moves with its velocity",
          .parameters = {{.key = "velocity",
                          .help = "prescribed velocity",
                          .quantity = Quantity::velocity,
                          .fallback = std::vector{0.0, 0.0, 0.0}}}};
}

}  // namespace mpm
