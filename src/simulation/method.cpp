#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/model.hpp>

#include "placement.hpp"

namespace mpm {

double default_cfl(const scene::Numerics& numerics)
{
  if (numerics.cfl) return *numerics.cfl;
  // Half of the measured limits or less; without re-mapping the limit at free edges is lower.
  if (numerics.update_order == scene::UpdateOrder::usl) return 0.4;
  return numerics.shape_function == scene::ShapeFunction::quadratic ? 1.0 : 0.6;
}

UpdateOrderKind update_order_of(const scene::Scene& scene)
{
  switch (scene.numerics.update_order) {
    case scene::UpdateOrder::musl:
      return UpdateOrderKind::musl;
    case scene::UpdateOrder::usf:
      return UpdateOrderKind::usf;
    case scene::UpdateOrder::usl:
      return UpdateOrderKind::usl;
  }
  throw InputError("unknown update order");
}

std::unique_ptr<Transfer<2>> make_transfer(const scene::Numerics& numerics, int particles_per_cell)
{
  const auto shape = [&] {
    switch (numerics.shape_function) {
      case scene::ShapeFunction::linear:
        return ShapeKind::linear;
      case scene::ShapeFunction::gimp:
        return ShapeKind::gimp;
      case scene::ShapeFunction::quadratic:
        return ShapeKind::quadratic;
    }
    throw InputError("unknown shape function");
  };
  const auto scheme = [&] {
    switch (numerics.scheme) {
      case scene::TransferScheme::flip:
        return SchemeKind::flip;
      case scene::TransferScheme::pic:
        return SchemeKind::pic;
      case scene::TransferScheme::apic:
        return SchemeKind::apic;
      case scene::TransferScheme::tpic:
        return SchemeKind::tpic;
    }
    throw InputError("unknown transfer scheme");
  };
  return make_transfer<2>(shape(), scheme(), particles_per_cell);
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
  WorkMap<2> work(layout.geometry, ranks_of(comm));
  for_each_particle_cell(scene, specimen, layout, share,
                         [&](const IndexVec<2>& cell) { work.add(cell); });
  work.sum_over_ranks(comm);
  const auto loads_under = [&](const Ownership<2>& ownership) {
    std::vector<double> loads(ownership.ranks(), 0.0);
    for_each_particle_cell(scene, specimen, layout, share, [&](const IndexVec<2>& cell) {
      loads[ownership.owner_of_cell(cell)] += 1;
    });
    sum_over_ranks(comm, loads);
    return loads;
  };
  return {comm, choose_partition<2>(layout.geometry, ranks_of(comm), partition_rules(scene), work,
                                    loads_under, nullptr)
                    .ownership};
}

}  // namespace mpm
