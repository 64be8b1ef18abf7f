#include <mpm/parallel/session.hpp>
#include <mpm/simulation/measures.hpp>

#include <algorithm>
#include <array>

namespace mpm {

template <int Dim>
ParticleSums<Dim> sum_particles(MPI_Comm comm, const std::vector<Body<Dim>>& bodies)
{
  std::array<GlobalIndex, 2> counts{0, 0};
  std::array<double, 4 + Dim> sums{};
  for (const Body<Dim>& body : bodies) {
    const ParticleStore& particles = body.particles;
    counts[0] += particles.size();
    for (const GlobalIndex id : particles.ids()) counts[1] += id;
    const int velocity = particles.motion().find("velocity");
    const int mass = particles.motion().find("mass");
    const int work = particles.state().find("plastic_work");
    Lanes m = 0, kinetic = 0, elastic = 0, plastic = 0, momentum[Dim];
    for (Lanes& component : momentum) component = 0;
    for (LocalIndex b = 0; b < particles.blocks(); ++b) {
      const double* motion = particles.motion().block(b);
      const double* state = particles.state().block(b);
      const Lanes mp = load(motion + mass * lane_count);
      Lanes squared = 0;
      for (int d = 0; d < Dim; ++d) {
        const Lanes v = load(motion + (velocity + d) * lane_count);
        momentum[d] += mp * v;
        squared += v * v;
      }
      m += mp;
      kinetic += 0.5 * mp * squared;
      elastic += body.law->elastic_energy(state);
      if (work >= 0) plastic += load(state + work * lane_count);
    }
    sums[0] += stdx::reduce(m);
    sums[1] += stdx::reduce(kinetic);
    sums[2] += stdx::reduce(elastic);
    sums[3] += stdx::reduce(plastic);
    for (int d = 0; d < Dim; ++d) sums[4 + d] += stdx::reduce(momentum[d]);
  }
  sum_over_ranks(comm, counts);
  sum_over_ranks(comm, sums);
  ParticleSums<Dim> result{counts[0], counts[1], sums[0], sums[1], sums[2], sums[3]};
  for (int d = 0; d < Dim; ++d) result.momentum[d] = sums[4 + d];
  return result;
}

template <int Dim>
Penetration find_behind(MPI_Comm comm, const std::vector<Body<Dim>>& bodies,
                        std::span<const RigidWall<Dim>* const> walls, double time,
                        const Vec<Dim>& spacing)
{
  constexpr std::size_t most_ids = 10;
  Penetration found;
  for (const Body<Dim>& body : bodies)
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      double deepest = 0, cells = 0;
      for (const RigidWall<Dim>* wall : walls) {
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

template <int Dim>
AxialStress axial_stress(const Body<Dim>& body, int axis)
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

template ParticleSums<2> sum_particles(MPI_Comm, const std::vector<Body<2>>&);
template ParticleSums<3> sum_particles(MPI_Comm, const std::vector<Body<3>>&);
template Penetration find_behind(MPI_Comm, const std::vector<Body<2>>&,
                                 std::span<const RigidWall<2>* const>, double, const Vec<2>&);
template Penetration find_behind(MPI_Comm, const std::vector<Body<3>>&,
                                 std::span<const RigidWall<3>* const>, double, const Vec<3>&);
template AxialStress axial_stress(const Body<2>&, int);
template AxialStress axial_stress(const Body<3>&, int);

}  // namespace mpm
