#include <mpm/core/error.hpp>
#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/lagrangian/self_contact.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/method.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpm {

bool is_total_lagrangian(const scene::Numerics& numerics)
{
  return numerics.formulation == scene::FormulationKind::total_lagrangian;
}

std::string limited_by(const scene::Numerics& numerics)
{
  if (is_total_lagrangian(numerics))
    return contact_stiffness(numerics) > 0
               ? fmt::format("cells in contact with stiffness {:.3g}", contact_stiffness(numerics))
               : std::string("cells that bend");
  return fmt::format("{} with {} and {}", numerics.shape_function->keyword,
                     numerics.scheme->keyword, numerics.update_order->keyword);
}

std::optional<double> stable_cfl_of(const scene::Numerics& numerics)
{
  // A flush contact is 2 kappa times as stiff as the cells that it lies between.
  if (is_total_lagrangian(numerics))
    return 0.95 / std::sqrt(1 + 2 * contact_stiffness(numerics) * borne_contact);
  return stable_cfl(*numerics.shape_function, *numerics.scheme, *numerics.update_order);
}

double default_cfl(const scene::Numerics& numerics)
{
  if (numerics.cfl) return *numerics.cfl;
  const auto stable = stable_cfl_of(numerics);
  if (!stable) throw InputError("no time step is stable with this shape function");
  if (!is_total_lagrangian(numerics)) return *stable * numerics.shape_function->cfl_share;
  // Cells of one point bear 1 / sqrt(1 + c_s^2 / c_p^2), in space twice that ratio: 0.71 at least.
  constexpr double share_in_contact = 0.9, of_cells_alone = 0.57;
  return std::min(*stable * share_in_contact, of_cells_alone);
}

double mass_scaling_of(const scene::Scene& scene)
{
  constexpr double in_crushing = 0.8;
  return scene.numerics.mass_scaling.value_or(
      std::holds_alternative<scene::Loading>(scene.motion) ? in_crushing : 0.0);
}

bool cells_may_fail(const scene::Scene& scene)
{
  return std::ranges::any_of(scene.materials, [](const scene::Material& material) {
    return material.failure.has_value();
  });
}

double stress_moment_of(const scene::Numerics& numerics)
{
  return is_total_lagrangian(numerics) ? 0.5 : numerics.update_order->stress_moment;
}

StepExtras extras_of(const scene::Numerics& numerics)
{
  return {numerics.scheme->refines ? numerics.refinement_order - 1 : 0,
          numerics.scheme->refines_before_forces, numerics.f_bar};
}

ReactionBook reaction_book(const scene::Numerics& numerics)
{
  const double share = numerics.scheme->book.velocity_share;
  return {share + numerics.pic_share * (1 - share)};
}

std::vector<std::string> method_words(const scene::Numerics& numerics, int dimensions)
{
  const char* space = dimensions == 3                          ? "in space"
                      : numerics.plane == scene::Plane::strain ? "plane strain"
                                                               : "plane stress";
  if (is_total_lagrangian(numerics))
    return {"total Lagrangian cells that bend", "central differences",
            contact_stiffness(numerics) > 0
                ? fmt::format("contact of stiffness {:.3g}", contact_stiffness(numerics))
                : "no contact",
            space};
  std::string shape(numerics.shape_function->words), scheme(numerics.scheme->words);
  if (numerics.domain != 1) shape += fmt::format(" with domains of {:.4g}", numerics.domain);
  if (numerics.scheme->refines) scheme += fmt::format("({})", numerics.refinement_order);
  if (numerics.pic_share > 0) scheme += fmt::format(" with {:.4g} % PIC", 100 * numerics.pic_share);
  return {shape, scheme, std::string(numerics.update_order->words), space};
}

template <int Dim>
TimeStep time_step_of(const Layout<Dim>& layout)
{
  return {layout.cfl, layout.crossed_in_step, layout.wave_speed, layout.largest_speed};
}

template <int Dim>
double expected_steps(const scene::Scene& scene, const Layout<Dim>& layout)
{
  const double steps = std::ceil(layout.end_time / time_step_of(layout).first());
  return scene.steps ? std::min(steps, double(*scene.steps)) : steps;
}

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(const scene::Numerics& numerics,
                                             int particles_per_cell)
{
  return make_transfer<Dim>(
      numerics.shape_function, numerics.scheme,
      {numerics.domain / particles_per_cell, numerics.pic_share, numerics.f_bar});
}

template <int Dim>
std::vector<Column> motion_columns(const scene::Numerics& numerics, int particles_per_cell,
                                   const Law<Dim>& law)
{
  if (is_total_lagrangian(numerics))
    return LocationCells<Dim>::columns(law, numerics.surface == scene::Surface::fitted);
  return make_transfer<Dim>(numerics, particles_per_cell)
      ->motion_columns(numerics.update_order->remaps);
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

template TimeStep time_step_of(const Layout<2>&);
template TimeStep time_step_of(const Layout<3>&);
template double expected_steps(const scene::Scene&, const Layout<2>&);
template double expected_steps(const scene::Scene&, const Layout<3>&);
template std::unique_ptr<Transfer<2>> make_transfer(const scene::Numerics&, int);
template std::unique_ptr<Transfer<3>> make_transfer(const scene::Numerics&, int);
template std::vector<Column> motion_columns(const scene::Numerics&, int, const Law<2>&);
template std::vector<Column> motion_columns(const scene::Numerics&, int, const Law<3>&);
template PartitionRules<2> partition_rules(const scene::Scene&);
template PartitionRules<3> partition_rules(const scene::Scene&);
template Partition<2> first_partition(MPI_Comm, const scene::Scene&, const micrograph::Specimen<2>&,
                                      const Layout<2>&);
template Partition<3> first_partition(MPI_Comm, const scene::Scene&, const micrograph::Specimen<3>&,
                                      const Layout<3>&);

}  // namespace mpm
