#include <mpm/parallel/session.hpp>
#include <mpm/simulation/measures.hpp>

#include <algorithm>

namespace mpm {

ParticleSums sum_particles(MPI_Comm comm, const std::vector<Body<2>>& bodies)
{
  std::array<GlobalIndex, 2> counts{0, 0};
  std::array<double, 6> sums{};
  for (const Body<2>& body : bodies) {
    const ParticleStore& particles = body.particles;
    counts[0] += particles.size();
    for (const GlobalIndex id : particles.ids()) counts[1] += id;
    const int velocity = particles.motion().find("velocity");
    const int mass = particles.motion().find("mass");
    const int work = particles.state().find("plastic_work");
    Lanes m = 0, kinetic = 0, elastic = 0, plastic = 0, px = 0, py = 0;
    for (LocalIndex b = 0; b < particles.blocks(); ++b) {
      const double* motion = particles.motion().block(b);
      const double* state = particles.state().block(b);
      const Lanes mp = load(motion + mass * lane_count);
      const Lanes vx = load(motion + velocity * lane_count);
      const Lanes vy = load(motion + (velocity + 1) * lane_count);
      m += mp;
      px += mp * vx;
      py += mp * vy;
      kinetic += 0.5 * mp * (vx * vx + vy * vy);
      elastic += body.law->elastic_energy(state);
      if (work >= 0) plastic += load(state + work * lane_count);
    }
    const Lanes all[] = {m, kinetic, elastic, plastic, px, py};
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += stdx::reduce(all[k]);
  }
  sum_over_ranks(comm, counts);
  sum_over_ranks(comm, sums);
  return {counts[0], counts[1], sums[0], sums[1], sums[2], sums[3], Vec<2>(sums[4], sums[5])};
}

Penetration find_behind(MPI_Comm comm, const std::vector<Body<2>>& bodies,
                        const std::vector<const RigidWall<2>*>& walls, double time,
                        const Vec<2>& spacing)
{
  constexpr std::size_t most_ids = 10;
  Penetration found;
  for (const Body<2>& body : bodies)
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      double deepest = 0, cells = 0;
      for (const RigidWall<2>* wall : walls) {
        const int axis = wall->placement().axis;
        const double depth = wall->depth(body.particles.motion()(axis, p), time);
        deepest = std::max(deepest, depth);
        cells = std::max(cells, depth / spacing[axis]);
      }
      if (deepest <= 0) continue;
      ++found.particles;
      found.deepest = std::max(found.deepest, deepest);
      if (cells > 1 && found.ids.size() < most_ids) found.ids.push_back(body.particles.ids()[p]);
    }
  sum_over_ranks(comm, std::span(&found.particles, 1));
  found.deepest = largest_over_ranks(comm, found.deepest);
  return found;
}

AxialStress axial_stress(const Body<2>& body, int axis)
{
  alignas(lane_alignment) double stress[6 * lane_count];
  const ParticleStore& particles = body.particles;
  const int mass = particles.motion().find("mass");
  Lanes mass_stress = 0, total = 0;
  for (LocalIndex b = 0; b < particles.blocks(); ++b) {
    body.law->cauchy_stress(particles.state().block(b), stress);
    const Lanes m = load(particles.motion().block(b) + mass * lane_count);
    mass_stress += m * load(stress + axis * lane_count);
    total += m;
  }
  return {stdx::reduce(mass_stress), stdx::reduce(total)};
}

}  // namespace mpm
