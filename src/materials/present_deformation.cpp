#include <mpm/materials/present_deformation.hpp>

#include <cmath>

namespace mpm {

template <int Dim>
PresentDeformation present_deformation(const Body<Dim>& body)
{
  const ParticleStore& particles = body.particles;
  const double undeformed = body.law->wave_speed();
  Lanes fastest = undeformed * undeformed;
  PresentDeformation present{};
  for (LocalIndex b = 0; b < particles.blocks(); ++b) {
    const double* state = particles.state().block(b);
    const LaneMask padding = load(state) == 0.0;  // initial_volume
    Lanes here = body.law->fastest_wave_squared(state);
    stdx::where(padding, here) = 0.0;
    fastest = stdx::max(fastest, here);
    const Lanes ratio = body.law->volume_ratio(state);
    const LaneMask sound = ratio >= least_volume_ratio && ratio <= largest_volume_ratio;
    if (present.beyond_bounds || stdx::all_of(sound || padding)) [[likely]]
      continue;
    for (int lane = lane_count; lane-- > 0;)
      if (const LocalIndex p = b * lane_count + lane; p < particles.size() && !sound[lane])
        present.beyond_bounds = {p, ratio[lane]};
  }
  present.wave_speed = std::sqrt(stdx::hmax(fastest));
  return present;
}

template PresentDeformation present_deformation(const Body<2>&);
template PresentDeformation present_deformation(const Body<3>&);

}  // namespace mpm
