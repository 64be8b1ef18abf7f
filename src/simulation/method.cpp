#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/model.hpp>

#include "placement.hpp"

namespace mpm {

namespace {

/// Largest stable step in units of h / c, c the present wave speed (docs/theory.md). Of a bar with
/// a free end at the worst place: spectral radius 1 of the whole step, two particles per cell. The
/// affine schemes: what crushed wood bears.
double stable_cfl(const scene::Numerics& numerics)
{
  const int shape = int(numerics.shape_function);  // linear, gimp, quadratic
  constexpr double usl[] = {0.014, 0.59, 0.82}, flip[] = {1.42, 1.75, 2.12},
                   pic[] = {1.25, 1.48, 1.86}, affine[] = {0.9, 0.9, 0.9};
  if (numerics.update_order == scene::UpdateOrder::usl) return usl[shape];
  switch (numerics.scheme) {
    case scene::TransferScheme::flip:
      return flip[shape];
    case scene::TransferScheme::pic:
      return pic[shape];
    default:
      return affine[shape];
  }
}

}  // namespace

double default_cfl(const scene::Numerics& numerics)
{
  if (numerics.cfl) return *numerics.cfl;
  // Below the limit, with linear functions the noise of particles that cross cells grows, and with
  // uniform GIMP thin walls that collapse lose the energy balance: ponderosa pine closes to 0.4 %
  // at 0.7 of the limit and to 2 % at 0.9 of it, with quadratic functions at 0.9 to 0.3 %.
  constexpr double share[] = {0.42, 0.7, 0.9};
  return share[int(numerics.shape_function)] * stable_cfl(numerics);
}

std::unique_ptr<UpdateOrder<2>> make_update_order(const scene::Numerics& numerics)
{
  switch (numerics.update_order) {
    case scene::UpdateOrder::musl:
      return make_musl<2>();
    case scene::UpdateOrder::usf:
      return make_usf<2>();
    case scene::UpdateOrder::usl:
      return make_usl<2>();
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
                                    const micrograph::Specimen<2>& specimen, const Layout& layout)
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
