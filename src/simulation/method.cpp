#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/model.hpp>

#include "placement.hpp"

namespace mpm {

double default_cfl(const scene::Numerics& numerics)
{
  if (numerics.cfl) return *numerics.cfl;
  const auto stable =
      stable_cfl(*numerics.shape_function, *numerics.scheme, *numerics.update_order);
  if (!stable) throw InputError("no time step is stable with this shape function");
  return numerics.shape_function->cfl_share * *stable;
}

PartitionRules<2> partition_rules(const scene::Scene& scene)
{
  PartitionRules<2> rules;
  switch (scene.numerics.decomposition) {
    case scene::DecompositionKind::automatic:
      rules.kind = PartitionKind::automatic;
      break;
    case scene::DecompositionKind::cuts:
      rules.kind = PartitionKind::cuts;
      break;
    case scene::DecompositionKind::metis:
      rules.kind = PartitionKind::metis;
      break;
  }
  rules.ranks = {scene.numerics.ranks[0], scene.numerics.ranks[1]};
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion))
    rules.keep_whole = axis_of(loading->piston);
  return rules;
}

Decomposition<2> make_decomposition(MPI_Comm comm, const scene::Scene& scene,
                                    const micrograph::SpecimenModel& specimen, const Layout& layout)
{
  // Each rank counts its share of the locations.
  const RowShare share{rank_of(comm), ranks_of(comm)};
  const auto particles = [&](const auto& visit) {
    for_each_particle_cell(scene, specimen, layout, share, visit);
  };
  WorkMap<2> work(layout.geometry, ranks_of(comm));
  particles([&](const IndexVec<2>& cell) { work.add(cell); });
  work.sum_over_ranks(comm);
  const auto loads_under = [&](const Ownership<2>& ownership) {
    std::vector<double> loads = loads_of<2>(ownership, particles);
    sum_over_ranks(comm, loads);
    return loads;
  };
  return {comm, choose_partition<2>(layout.geometry, ranks_of(comm), partition_rules(scene), work,
                                    loads_under, nullptr)
                    .ownership};
}

}  // namespace mpm
