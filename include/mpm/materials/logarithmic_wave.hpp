#pragma once
/// The present fastest wave of laws that are linear between Kirchhoff stress tau and logarithmic
/// strain (or its rate), with the P-wave modulus M at most. A longitudinal wave on top of a stretch
/// F along its way then moves at c^2 = F^2 (dP/dF) / rho_0 = (M - tau) / rho_0 with P = tau / F:
/// compression makes it faster.

#include <mpm/materials/law.hpp>

namespace mpm {

/// A lower bound of the principal values, exact in 2D: mean - sqrt((Dim - 1) / Dim s : s), s the
/// deviator within Dim dimensions.
template <int Dim>
Lanes most_compressive(const double* symmetric)
{
  Lanes trace = 0.0, squared = 0.0;
  for (int k = 0; k < symmetric_components<Dim>; ++k) {
    const Lanes value = load(symmetric + k * lane_count);
    if (k < Dim) trace += value;
    squared += (k < Dim ? 1.0 : 2.0) * value * value;
  }
  const Lanes mean = trace / double(Dim);
  const Lanes deviator = stdx::max(squared - trace * mean, Lanes(0.0));
  return mean - stdx::sqrt(deviator * (double(Dim - 1) / Dim));
}

/// Of one block of such a law, m^2/s^2; tension is taken as no stress.
template <int Dim>
Lanes logarithmic_wave_squared(const Law<Dim>& law, double density, const double* state)
{
  alignas(lane_alignment) double force_stress[symmetric_components<Dim> * lane_count];
  law.force_stress(state, 1, force_stress);
  const Lanes v0 = load(state);  // initial_volume
  Lanes pressure = 0.0;          // largest - tau, Pa
  stdx::where(v0 > 0.0, pressure) = -most_compressive<Dim>(force_stress) / v0;
  pressure = stdx::max(pressure, Lanes(0.0));
  const double undeformed = law.wave_speed();
  return undeformed * undeformed + pressure / density;
}

}  // namespace mpm
