#include <mpm/materials/present_wave_speed.hpp>

#include <cmath>

namespace mpm {

template <int Dim>
double present_wave_speed(const Body<Dim>& body)
{
  const ParticleStore& particles = body.particles;
  const double undeformed = body.law->wave_speed();
  Lanes fastest = undeformed * undeformed;
  for (LocalIndex b = 0; b < particles.blocks(); ++b) {
    const double* state = particles.state().block(b);
    Lanes here = 0.0;
    stdx::where(load(state) > 0.0, here) = body.law->fastest_wave_squared(state);
    fastest = stdx::max(fastest, here);
  }
  return std::sqrt(stdx::hmax(fastest));
}

template double present_wave_speed(const Body<2>&);
template double present_wave_speed(const Body<3>&);

}  // namespace mpm
