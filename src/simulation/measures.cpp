#include <mpm/parallel/session.hpp>
#include <mpm/simulation/measures.hpp>

#include <algorithm>
#include <array>

namespace mpm {

template <int Dim>
Sums<Dim> sum_over_bodies(const Formulation<Dim>& formulation)
{
  const Carried<Dim> carried = formulation.carried();
  const FailedCells failed = carried.failed.value_or(FailedCells{});
  std::array<GlobalIndex, 5> counts{0, 0, carried.contact ? carried.contact->pairs : 0,
                                    failed.cells, failed.id_sum};
  std::array<double, 11 + Dim> sums{};
  sums[1] = carried.kinetic_energy;
  sums[2] = carried.elastic_energy;
  if (carried.contact) {
    sums[4] = carried.contact->energy;
    sums[5] = carried.contact->overlapped_area;
    sums[6] = carried.contact->friction_work;
  }
  for (int d = 0; d < Dim; ++d) sums[7 + d] = carried.momentum[d];
  sums[7 + Dim] = failed.mass;
  sums[8 + Dim] = failed.energy;
  sums[9 + Dim] = failed.plastic_work;
  sums[10 + Dim] = carried.added_mass.value_or(0);
  for (const Body<Dim>& body : formulation.bodies()) {
    const ParticleStore& particles = body.particles;
    counts[0] += particles.size();
    for (const GlobalIndex id : particles.ids()) counts[1] += id;
    const int mass = particles.motion().find("mass");
    const int work = particles.state().find("plastic_work");
    Lanes m = 0, elastic = 0, plastic = 0;
    for (LocalIndex b = 0; b < particles.blocks(); ++b) {
      const double* state = particles.state().block(b);
      m += load(particles.motion().block(b) + mass * lane_count);
      elastic += body.law->elastic_energy(state);
      if (work >= 0) plastic += load(state + work * lane_count);
    }
    sums[0] += stdx::reduce(m);
    sums[2] += stdx::reduce(elastic);
    sums[3] += stdx::reduce(plastic);
  }
  const MPI_Comm comm = formulation.decomposition().comm();
  sum_over_ranks(comm, counts);
  sum_over_ranks(comm, sums);
  Sums<Dim> result{counts[0], counts[1], sums[0], sums[1], sums[2], sums[3] + sums[9 + Dim]};
  for (int d = 0; d < Dim; ++d) result.momentum[d] = sums[7 + d];
  if (carried.contact)
    result.contact = {sums[4], sums[5], largest_over_ranks(comm, carried.contact->deepest_overlap),
                      counts[2], sums[6]};
  if (carried.failed)
    result.failed = {counts[3], counts[4], sums[7 + Dim], sums[8 + Dim], sums[9 + Dim]};
  if (carried.added_mass) result.added_mass = sums[10 + Dim];
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

template Sums<2> sum_over_bodies(const Formulation<2>&);
template Sums<3> sum_over_bodies(const Formulation<3>&);
template Penetration find_behind(MPI_Comm, const std::vector<Body<2>>&,
                                 std::span<const RigidWall<2>* const>, double, const Vec<2>&);
template Penetration find_behind(MPI_Comm, const std::vector<Body<3>>&,
                                 std::span<const RigidWall<3>* const>, double, const Vec<3>&);
template AxialStress axial_stress(const Body<2>&, int);
template AxialStress axial_stress(const Body<3>&, int);

}  // namespace mpm
