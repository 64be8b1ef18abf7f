#pragma once
/// Von Mises return mapping with sigma_zz = 0 (Simo & Taylor 1986, IJNME 22:649, in the form of
/// de Souza Neto, Peric & Owen 2008): shared by the logarithmic and the rate form.

#include <mpm/core/lanes.hpp>
#include <mpm/materials/elastic_constants.hpp>

namespace mpm {

/// The return scales the sum of the normal stresses and the deviator separately.
struct PlaneStressReturn {
  Lanes sum_scale = 1.0;         ///< of s1 + s2
  Lanes difference_scale = 1.0;  ///< of s1 - s2 (and of the shear stress)
  Lanes plastic_strain = 0.0;    ///< increment of the equivalent plastic strain
  bool any = false;              ///< whether any lane yields
};

/// `sum` = s1 + s2 and `difference_squared` = (s1 - s2)^2 of the trial principal stresses.
inline PlaneStressReturn return_to_yield_plane_stress(const Lanes& sum,
                                                      const Lanes& difference_squared,
                                                      const Lanes& plastic_strain,
                                                      const IsotropicConstants& elastic,
                                                      const YieldConstants& yield)
{
  PlaneStressReturn result;
  const double bulk = elastic.youngs_modulus / (3 * (1 - elastic.poisson_ratio));
  const double shear = 2 * elastic.shear_modulus();
  const Lanes a = sum * sum / 6.0, b = 0.5 * difference_squared;
  const Lanes old_yield = yield.yield_stress + yield.hardening_modulus * plastic_strain;
  const LaneMask yields = 0.5 * (a + b) > old_yield * old_yield / 3.0;
  if (!stdx::any_of(yields)) return result;
  result.any = true;
  Lanes gamma = 0.0;
  const double tolerance = 1e-14 * yield.yield_stress * yield.yield_stress;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Lanes p = 1.0 / (1.0 + bulk * gamma), q = 1.0 / (1.0 + shear * gamma);
    const Lanes xi = a * p * p + b * q * q;
    const Lanes root = stdx::sqrt(2.0 / 3.0 * xi);
    const Lanes stress = old_yield + yield.hardening_modulus * gamma * root;
    Lanes residual = 0.5 * xi - stress * stress / 3.0;
    stdx::where(!yields, residual) = 0.0;
    if (stdx::all_of(stdx::abs(residual) <= tolerance)) break;
    const Lanes xi_slope = -2.0 * (a * bulk * p * p * p + b * shear * q * q * q);
    const Lanes slope = 0.5 * xi_slope - 2.0 / 3.0 * stress * yield.hardening_modulus *
                                             (root + gamma * xi_slope / (3.0 * root));
    stdx::where(yields, gamma) = gamma - residual / slope;
  }
  result.sum_scale = 1.0 / (1.0 + bulk * gamma);
  result.difference_scale = 1.0 / (1.0 + shear * gamma);
  const Lanes xi = a * result.sum_scale * result.sum_scale +
                   b * result.difference_scale * result.difference_scale;
  result.plastic_strain = gamma * stdx::sqrt(2.0 / 3.0 * xi);
  return result;
}

}  // namespace mpm
