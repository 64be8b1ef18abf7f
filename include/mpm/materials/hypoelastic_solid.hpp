#pragma once
/// Rate form in space: the Jaumann rate of the Kirchhoff stress is C : D, with or without von Mises
/// plasticity. The spin of a step turns the stress by its exact rotation (Hughes & Winget 1980,
/// IJNME 15:1862), so a rigid rotation of any size leaves the invariants of the stress unchanged.
/// In the plane, the law in turning axes (hypoelastic.hpp) gives the same stress as long as the
/// principal axes of stretch keep their directions in the material.

#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/law.hpp>

#include <optional>

namespace mpm {

/// Isotropic; purely elastic without `yield`.
std::unique_ptr<Law<3>> make_hypoelastic_solid(const IsotropicConstants& elastic, double density,
                                               std::optional<YieldConstants> yield);

}  // namespace mpm
