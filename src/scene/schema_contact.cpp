#include <mpm/scene/schema.hpp>

namespace mpm::scene {

template <>
const std::vector<Parameter<BodyContact>>& parameters<BodyContact>()
{
  using C = BodyContact;
  static const std::vector<Parameter<C>> rows{
      member<C>("between", &C::between, {.need = Need::required},
                "the names of two materials that can be deformed; with formulation: "
                "total_lagrangian one of them may be rigid, or one stand twice, for its friction "
                "with itself"),
      member<C>("friction", &C::friction, {.bound = at_least(0)},
                "largest tangential over normal force; 0: none, a large one: they stick while they "
                "are pressed"),
  };
  return rows;
}

}  // namespace mpm::scene
