#include <mpm/materials/hypoelastic.hpp>

#include <cmath>
#include <sstream>

#include "elastic_parameters.hpp"

namespace mpm {

namespace {

/// The elastic energy is positive for |nu_T| < 1 (the bound of poisson_ratio) and
/// nu_A^2 < E_A (1 - nu_T) / (2 E_T).
std::optional<Contradiction> check(const ParameterValues& v)
{
  const double limit = std::sqrt(v.number("axial_modulus") * (1 - v.number("poisson_ratio")) /
                                 (2 * v.number("youngs_modulus")));
  if (std::abs(v.number("axial_poisson_ratio")) < limit) return std::nullopt;
  std::ostringstream reason;
  reason.precision(4);
  reason << "must lie within +-" << limit
         << ", the square root of axial_modulus (1 - poisson_ratio) / (2 youngs_modulus), or "
            "stretching would release energy";
  return Contradiction{"axial_poisson_ratio", reason.str()};
}

std::unique_ptr<Law<2>> make(const ParameterValues& v, PlaneAssumption plane)
{
  const TransverselyIsotropicConstants fibre{
      v.number("youngs_modulus"), v.number("poisson_ratio"), v.number("axial_modulus"),
      v.number("axial_poisson_ratio"), v.number("axial_shear_modulus")};
  return make_hypoelastic(plane,
                          v.word("unique_axis") == "out_of_plane"
                              ? PlaneStiffness::axis_out_of_plane(plane, fibre)
                              : PlaneStiffness::axis_in_plane(plane, fibre, v.number("axis_angle")),
                          v.number("density"));
}

}  // namespace

LawRow transversely_isotropic_law()
{
  return {.keyword = "transversely_isotropic",
          .help = "elastic, with one unique axis",
          .parameters = {density_parameter(),
                         youngs_modulus_parameter(),
                         {.key = "poisson_ratio",
                          .help = "Poisson's ratio within the plane across the unique axis",
                          .bound = between(-1, 1),
                          .example = 0.33},
                         {.key = "axial_modulus",
                          .help = "Young's modulus along the unique axis",
                          .quantity = Quantity::pressure,
                          .bound = above(0),
                          .example = 35e9},
                         {.key = "axial_poisson_ratio",
                          .help = "contraction across over extension along the unique axis, "
                                  "loaded along it",
                          .example = 0.33},
                         {.key = "axial_shear_modulus",
                          .help = "shear modulus in planes that hold the unique axis",
                          .quantity = Quantity::pressure,
                          .bound = above(0),
                          .example = 3.5e9},
                         {.key = "unique_axis",
                          .help = "whether the unique axis stands on the picture or lies in it",
                          .choices = {"out_of_plane", "in_plane"}},
                         {.key = "axis_angle",
                          .help = "from +x to the unique axis, counter-clockwise",
                          .quantity = Quantity::angle,
                          .fallback = 0.0,
                          .example = 0.5,
                          .only = KindParameter::Only{"unique_axis", "in_plane"}}},
          .in_plane = make,
          .check = check};
}

}  // namespace mpm
