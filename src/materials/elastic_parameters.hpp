#pragma once
/// Keys that several laws have in common. The example is the cell wall of J. A. Nairn (2006), Wood
/// Fiber Sci. 38(4):576.

#include <mpm/materials/laws.hpp>

namespace mpm {

inline KindParameter density_parameter()
{
  return {.key = "density",
          .help = "mass per volume of the solid",
          .quantity = Quantity::density,
          .bound = above(0),
          .example = 1500};
}

inline KindParameter youngs_modulus_parameter()
{
  return {.key = "youngs_modulus",
          .help = "Young's modulus; across the unique axis if transversely isotropic",
          .quantity = Quantity::pressure,
          .bound = above(0),
          .example = 10.6e9};
}

inline KindParameter poisson_ratio_parameter()
{
  return {.key = "poisson_ratio",
          .help = "Poisson's ratio",
          .bound = between(-1, 0.5),
          .example = 0.33};
}

inline KindParameter strain_measure_parameter()
{
  return {.key = "strain_measure",
          .help = "logarithmic (Hencky) strain, or a rate of small strain with rotation",
          .choices = {"hencky", "hypoelastic"}};
}

inline IsotropicConstants isotropic_constants(const ParameterValues& values)
{
  return {values.number("youngs_modulus"), values.number("poisson_ratio")};
}

inline bool is_hencky(const ParameterValues& values)
{
  return values.word("strain_measure") == "hencky";
}

}  // namespace mpm
