#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>
#include <mpm/materials/hypoelastic_solid.hpp>

#include "elastic_parameters.hpp"

namespace mpm {

LawRow isotropic_law()
{
  return {.keyword = "isotropic",
          .help = "elastic, the same in all directions",
          .parameters = {strain_measure_parameter(), density_parameter(),
                         youngs_modulus_parameter(), poisson_ratio_parameter()},
          .in_plane =
              [](const ParameterValues& v, PlaneAssumption plane) {
                const IsotropicConstants elastic = isotropic_constants(v);
                if (is_hencky(v))
                  return make_hencky(plane, elastic, v.number("density"), std::nullopt);
                return make_hypoelastic(plane, PlaneStiffness::isotropic(plane, elastic),
                                        v.number("density"));
              },
          .in_space =
              [](const ParameterValues& v) {
                if (is_hencky(v))
                  return make_hencky_solid(isotropic_constants(v), v.number("density"),
                                           std::nullopt);
                return make_hypoelastic_solid(isotropic_constants(v), v.number("density"),
                                              std::nullopt);
              }};
}

}  // namespace mpm
