#pragma once
/// What all ranks' bodies of a total Lagrangian step come to.

#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mpm {

template <int Dim>
struct SumsOfBodies {
  std::vector<double> places;  ///< m, all components of all cells' middles, by id
  double energy = 0, stored = 0, work = 0, bending = 0;  ///< J; stored: without the kinetic one
  double overlapped = 0;                                 ///< m^2, in space m^3
  double deepest = 0;                                    ///< overlap, of a cell
  GlobalIndex pairs = 0, failed = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero(), impulse = Vec<Dim>::Zero();

  /// Of `cells` in all; takes the reactions. Collective.
  SumsOfBodies(MPI_Comm comm, TotalLagrangian<Dim>& stepper, GlobalIndex cells)
      : places(std::size_t(Dim * cells), 0.0)
  {
    const auto take = [&](const Reaction<Dim>& reaction) {
      work += reaction.work;
      impulse += reaction.impulse;
    };
    for (const Body<Dim>& body : stepper.bodies()) {
      const ParticleStore& particles = body.particles;
      for (LocalIndex p = 0; p < particles.size(); ++p)
        for (int d = 0; d < Dim; ++d)
          places[std::size_t(Dim * particles.ids()[std::size_t(p)] + d)] = particles.motion()(d, p);
      const int plastic = particles.state().find("plastic_work");
      for (LocalIndex b = 0; b < particles.blocks(); ++b) {
        const double* state = particles.state().block(b);
        stored += stdx::reduce(body.law->elastic_energy(state));
        if (plastic >= 0) stored += stdx::reduce(load(state + plastic * lane_count));
      }
    }
    const Carried<Dim> carried = stepper.carried();
    bending = carried.elastic_energy;
    stored += bending + carried.contact->energy;
    if (carried.failed) {
      stored += carried.failed->energy + carried.failed->plastic_work;
      failed = carried.failed->cells;
    }
    energy = stored + carried.kinetic_energy;
    overlapped = carried.contact->overlapped_area;
    deepest = largest_over_ranks(comm, carried.contact->deepest_overlap);
    pairs = carried.contact->pairs;
    momentum = carried.momentum;
    take(stepper.take_reaction());
    for (const auto& condition : stepper.slots().conditions) take(condition->take_reaction());
    for (double* sum : {&energy, &stored, &work, &bending, &overlapped})
      sum_over_ranks(comm, std::span(sum, 1));
    sum_over_ranks(comm, std::span(momentum.data(), Dim));
    sum_over_ranks(comm, std::span(impulse.data(), Dim));
    sum_over_ranks(comm, std::span(&pairs, 1));
    sum_over_ranks(comm, std::span(&failed, 1));
    sum_over_ranks(comm, places);
  }
};

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

}  // namespace mpm
