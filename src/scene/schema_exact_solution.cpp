#include <mpm/scene/schema.hpp>

namespace mpm::scene {

template <>
const std::vector<Parameter<ExactSolution>>& parameters<ExactSolution>()
{
  using E = ExactSolution;
  const Traits stress{.quantity = Quantity::pressure, .default_text = "not compared"};
  static const std::vector<Parameter<E>> rows{
      member<E>("displacement", &E::displacement,
                {.quantity = Quantity::length, .default_text = "not compared"},
                "of every particle from its place at t = 0, which formulas name X, Y and Z"),
      member<E>("velocity", &E::velocity,
                {.quantity = Quantity::velocity, .default_text = "not compared"},
                "of every particle, at the moment of the velocities: half a step before the "
                "positions, with usf half a step after"),
      member<E>("stress_xx", &E::stress_xx, stress, "Cauchy stress, tension positive"),
      member<E>("stress_yy", &E::stress_yy, stress, "the same"),
      member<E>("stress_zz", &E::stress_zz, stress, "the same"),
      member<E>("stress_xy", &E::stress_xy, stress, "the same"),
      member<E>("stress_yz", &E::stress_yz, stress, "the same").in_space(),
      member<E>("stress_xz", &E::stress_xz, stress, "the same").in_space(),
  };
  return rows;
}

}  // namespace mpm::scene
