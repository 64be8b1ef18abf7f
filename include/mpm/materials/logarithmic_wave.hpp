#pragma once
/// The present fastest wave of laws that are linear between Kirchhoff stress tau and logarithmic
/// strain (or its rate), with the P-wave modulus M at most. A longitudinal wave on top of a stretch
/// F along its way then moves at c^2 = F^2 (dP/dF) / rho_0 = (M - tau) / rho_0 with P = tau / F:
/// compression makes it faster. A transverse one along the longer of two principal axes moves at
/// c^2 = (tau_1 - tau_2) / (1 - (lambda_2 / lambda_1)^2) / rho_0, with tau_1 - tau_2 =
/// 2 mu ln(lambda_1 / lambda_2) (Ogden 1984, Non-linear Elastic Deformations, section 6.4): tension
/// makes that one faster.

#include <mpm/core/lanes.hpp>
#include <mpm/materials/law.hpp>

namespace mpm {

/// Bounds, exact in 2D: of the principal values mean - sqrt((Dim - 1) / Dim s : s) from below, s
/// the deviator within Dim dimensions; of their differences sqrt(2 s : s) from above.
struct PrincipalBounds {
  Lanes least, difference;
};

template <int Dim>
PrincipalBounds principal_bounds(const double* symmetric)
{
  Lanes trace = 0.0, squared = 0.0;
  for (int k = 0; k < symmetric_components<Dim>; ++k) {
    const Lanes value = load(symmetric + k * lane_count);
    if (k < Dim) trace += value;
    squared += (k < Dim ? 1.0 : 2.0) * value * value;
  }
  const Lanes mean = trace / double(Dim);
  const Lanes deviator = stdx::max(squared - trace * mean, Lanes(0.0));
  return {mean - stdx::sqrt(deviator * (double(Dim - 1) / Dim)), stdx::sqrt(2.0 * deviator)};
}

/// Of one block of such a law, m^2/s^2; tension along the way is taken as no stress.
template <int Dim>
Lanes logarithmic_wave_squared(const Law<Dim>& law, double density, double shear_modulus,
                               const double* state)
{
  alignas(lane_alignment) double force_stress[symmetric_components<Dim> * lane_count];
  law.force_stress(state, 1, force_stress);
  const Lanes v0 = load(state);  // initial_volume
  const PrincipalBounds bounds = principal_bounds<Dim>(force_stress);
  Lanes pressure = 0.0, difference = 0.0;  // largest - tau, and of two tau, Pa
  stdx::where(v0 > 0.0, pressure) = -bounds.least / v0;
  stdx::where(v0 > 0.0, difference) = bounds.difference / v0;
  pressure = stdx::max(pressure, Lanes(0.0));
  // Too slow where the two are alike: there the longitudinal one is faster.
  const Lanes ratio = stdx::min(difference / shear_modulus, Lanes(100.0));
  const Lanes transverse = difference / (1.0 - lane_exp(-stdx::max(ratio, Lanes(1e-3))));
  const double undeformed = law.wave_speed();
  return stdx::max(undeformed * undeformed + pressure / density, transverse / density);
}

}  // namespace mpm
