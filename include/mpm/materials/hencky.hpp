#pragma once
/// Isotropic elasticity in logarithmic (Hencky) strain, with or without von Mises plasticity, from
/// the elastic left Cauchy-Green tensor b_e (Weber & Anand 1990; Simo 1992; de Souza Neto, Peric &
/// Owen 2008, ch. 14). Confined compression: tau = (lambda + 2 mu) ln F, stiffening to any density.

#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/law.hpp>

#include <optional>

namespace mpm {

/// Plane strain or plane stress; purely elastic without `yield`.
std::unique_ptr<Law<2>> make_hencky(PlaneAssumption plane, const IsotropicConstants& elastic,
                                    double density, std::optional<YieldConstants> yield);

/// In space; purely elastic without `yield`.
std::unique_ptr<Law<3>> make_hencky_solid(const IsotropicConstants& elastic, double density,
                                          std::optional<YieldConstants> yield);

}  // namespace mpm
