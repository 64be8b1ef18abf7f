#pragma once
#include <mpm/materials/law.hpp>

namespace mpm {

/// Speed of the fastest wave in the particles as they are now, m/s; at least the law's own.
///
/// All laws here are linear between Kirchhoff stress tau and logarithmic strain (or its rate), with
/// the P-wave modulus M at most. A longitudinal wave on top of a stretch F along its way then moves
/// at c^2 = F^2 (dP/dF) / rho_0 = (M - tau) / rho_0 with P = tau / F: compression makes it faster.
template <int Dim>
double present_wave_speed(const Body<Dim>& body);

}  // namespace mpm
