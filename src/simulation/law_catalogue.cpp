#include <mpm/core/error.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>
#include <mpm/simulation/model.hpp>

namespace mpm {

std::unique_ptr<Law<2>> make_law(const scene::Material& m, scene::Plane scene_plane)
{
  const PlaneAssumption plane =
      scene_plane == scene::Plane::strain ? PlaneAssumption::strain : PlaneAssumption::stress;
  const IsotropicConstants elastic{m.youngs_modulus, m.poisson_ratio};
  const YieldConstants yield{m.yield_stress, m.hardening_modulus};
  const TransverselyIsotropicConstants fibre{m.youngs_modulus, m.poisson_ratio, m.axial_modulus,
                                             m.axial_poisson_ratio, m.axial_shear_modulus};
  const bool hencky = m.strain_measure == scene::StrainMeasure::hencky;
  switch (m.law) {
    case scene::Law::isotropic:
      if (hencky) return make_hencky(plane, elastic, m.density, std::nullopt);
      return make_hypoelastic(plane, PlaneStiffness::isotropic(plane, elastic), m.density);
    case scene::Law::von_mises:
      if (hencky) return make_hencky(plane, elastic, m.density, yield);
      return make_hypoelastic_von_mises(plane, elastic, yield, m.density);
    case scene::Law::transversely_isotropic:
      return make_hypoelastic(plane,
                              m.unique_axis == scene::UniqueAxis::out_of_plane
                                  ? PlaneStiffness::axis_out_of_plane(plane, fibre)
                                  : PlaneStiffness::axis_in_plane(plane, fibre, m.axis_angle),
                              m.density);
    case scene::Law::rigid:
      break;
  }
  throw InputError("material '" + m.name + "' is rigid and has no stress");
}

}  // namespace mpm
