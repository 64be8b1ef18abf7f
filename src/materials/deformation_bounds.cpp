#include <mpm/materials/deformation_bounds.hpp>

namespace mpm {

template <int Dim>
std::optional<BeyondBounds> find_beyond_bounds(const Body<Dim>& body)
{
  const ParticleStore& particles = body.particles;
  for (LocalIndex b = 0; b < particles.blocks(); ++b) {
    const double* state = particles.state().block(b);
    const Lanes ratio = body.law->volume_ratio(state);
    const LaneMask sound = ratio >= least_volume_ratio && ratio <= largest_volume_ratio;
    if (stdx::all_of(sound || load(state) == 0.0)) [[likely]]
      continue;
    for (int lane = 0; lane < lane_count; ++lane)
      if (const LocalIndex p = b * lane_count + lane; p < particles.size() && !sound[lane])
        return BeyondBounds{p, ratio[lane]};
  }
  return std::nullopt;
}

template std::optional<BeyondBounds> find_beyond_bounds(const Body<2>&);
template std::optional<BeyondBounds> find_beyond_bounds(const Body<3>&);

}  // namespace mpm
