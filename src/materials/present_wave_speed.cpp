#include <mpm/materials/present_wave_speed.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

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

}  // namespace

template <int Dim>
double present_wave_speed(const Body<Dim>& body)
{
  const ParticleStore& particles = body.particles;
  const int volume = particles.state().find("initial_volume");
  alignas(lane_alignment) double force_stress[symmetric_components<Dim> * lane_count];
  Lanes pressure = 0.0;  // largest - tau, Pa
  for (LocalIndex b = 0; b < particles.blocks(); ++b) {
    const double* state = particles.state().block(b);
    body.law->force_stress(state, 1, force_stress);
    const Lanes v0 = load(state + volume * lane_count);
    Lanes here = 0.0;
    stdx::where(v0 > 0.0, here) = -most_compressive<Dim>(force_stress) / v0;
    pressure = stdx::max(pressure, here);
  }
  const double undeformed = body.law->wave_speed();
  return std::sqrt(undeformed * undeformed + stdx::hmax(pressure) / body.density);
}

template double present_wave_speed(const Body<2>&);
template double present_wave_speed(const Body<3>&);

}  // namespace mpm
