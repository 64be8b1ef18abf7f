#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/method.hpp>

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

template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_update_order(const scene::Numerics& numerics)
{
  switch (numerics.update_order) {
    case scene::UpdateOrder::musl:
      return make_musl<Dim>();
    case scene::UpdateOrder::usf:
      return make_usf<Dim>();
    case scene::UpdateOrder::usl:
      return make_usl<Dim>();
  }
  throw InputError("unknown update order");
}

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(const scene::Numerics& numerics,
                                             int particles_per_cell)
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
  return make_transfer<Dim>(shape(), scheme(), particles_per_cell);
}

template <int Dim>
PartitionRules<Dim> partition_rules(const scene::Scene& scene)
{
  PartitionRules<Dim> rules;
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
  for (int d = 0; d < Dim; ++d) rules.ranks[d] = scene.numerics.ranks[std::size_t(d)];
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion))
    rules.keep_whole = axis_of(loading->piston);
  return rules;
}

template <int Dim>
Partition<Dim> first_partition(MPI_Comm comm, const scene::Scene& scene,
                               const micrograph::Specimen<Dim>& specimen, const Layout<Dim>& layout)
{
  const auto particles = [&](const auto& visit) {
    for_each_particle_cell(scene, specimen, layout, rank_of(comm), ranks_of(comm), visit);
  };
  WorkMap<Dim> work(layout.geometry, ranks_of(comm));
  particles([&](const IndexVec<Dim>& cell) { work.add(cell); });
  work.sum_over_ranks(comm);
  const auto loads_under = [&](const Ownership<Dim>& ownership) {
    std::vector<double> loads = loads_of<Dim>(ownership, particles);
    sum_over_ranks(comm, loads);
    return loads;
  };
  return choose_partition<Dim>(layout.geometry, ranks_of(comm), partition_rules<Dim>(scene), work,
                               loads_under, nullptr);
}

template std::unique_ptr<UpdateOrder<2>> make_update_order(const scene::Numerics&);
template std::unique_ptr<UpdateOrder<3>> make_update_order(const scene::Numerics&);
template std::unique_ptr<Transfer<2>> make_transfer(const scene::Numerics&, int);
template std::unique_ptr<Transfer<3>> make_transfer(const scene::Numerics&, int);
template PartitionRules<2> partition_rules(const scene::Scene&);
template PartitionRules<3> partition_rules(const scene::Scene&);
template Partition<2> first_partition(MPI_Comm, const scene::Scene&, const micrograph::Specimen<2>&,
                                      const Layout<2>&);
template Partition<3> first_partition(MPI_Comm, const scene::Scene&, const micrograph::Specimen<3>&,
                                      const Layout<3>&);

}  // namespace mpm
