#pragma once
/// Rate form: the Kirchhoff stress in axes that turn with the material (Green-Naghdi: R from
/// F = R U) grows with the rate of deformation in these axes,
/// d/dt (R^T tau R) = C : (R^T D R). Any plane stiffness; isotropic ones may yield (von Mises).
/// Midpoint velocity gradient and midpoint rotation (Hughes & Winget 1980, IJNME 15:1862): a rigid
/// rotation of any size leaves the stress in the turning axes unchanged.

#include <mpm/materials/law.hpp>
#include <mpm/materials/plane_stiffness.hpp>

#include <optional>

namespace mpm {

std::unique_ptr<Law<2>> make_hypoelastic(PlaneAssumption plane, const PlaneStiffness& stiffness,
                                         double density);

std::unique_ptr<Law<2>> make_hypoelastic_von_mises(PlaneAssumption plane,
                                                   const IsotropicConstants& elastic,
                                                   const YieldConstants& yield, double density);

}  // namespace mpm
