#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>
#include <mpm/materials/hypoelastic_solid.hpp>

#include "elastic_parameters.hpp"

namespace mpm {

namespace {

YieldConstants yield_constants(const ParameterValues& values)
{
  return {values.number("yield_stress"), values.number("hardening_modulus")};
}

}  // namespace

LawRow von_mises_law()
{
  return {.keyword = "von_mises",
          .help = "isotropic elastic up to the von Mises stress at which it flows",
          .parameters = {strain_measure_parameter(),
                         density_parameter(),
                         youngs_modulus_parameter(),
                         poisson_ratio_parameter(),
                         {.key = "yield_stress",
                          .help = "uniaxial yield stress",
                          .quantity = Quantity::pressure,
                          .bound = above(0),
                          .example = 500e6},
                         {.key = "hardening_modulus",
                          .help = "slope of the yield stress over plastic strain; 0: perfectly "
                                  "plastic",
                          .quantity = Quantity::pressure,
                          .bound = at_least(0),
                          .fallback = 0.0,
                          .example = 1e9}},
          .in_plane =
              [](const ParameterValues& v, PlaneAssumption plane) {
                const IsotropicConstants elastic = isotropic_constants(v);
                const YieldConstants yield = yield_constants(v);
                if (is_hencky(v)) return make_hencky(plane, elastic, v.number("density"), yield);
                return make_hypoelastic_von_mises(plane, elastic, yield, v.number("density"));
              },
          .in_space =
              [](const ParameterValues& v) {
                if (is_hencky(v))
                  return make_hencky_solid(isotropic_constants(v), v.number("density"),
                                           yield_constants(v));
                return make_hypoelastic_solid(isotropic_constants(v), v.number("density"),
                                              yield_constants(v));
              }};
}

}  // namespace mpm
