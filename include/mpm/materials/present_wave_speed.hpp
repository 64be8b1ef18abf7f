#pragma once
#include <mpm/materials/body.hpp>

namespace mpm {

/// Speed of the fastest wave in the particles as they are now, m/s; at least the law's own.
template <int Dim>
double present_wave_speed(const Body<Dim>& body);

}  // namespace mpm
