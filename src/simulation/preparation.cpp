#include <mpm/core/memory.hpp>
#include <mpm/parallel/launcher.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/preparation.hpp>
#include <mpm/simulation/warnings.hpp>

namespace mpm {

namespace {

micrograph::Share share_of(MPI_Comm comm)
{
  return {rank_of(comm), ranks_of(comm),
          [comm](std::span<double> values) { sum_over_ranks(comm, values); }};
}

/// A scene that cannot be laid out stops every rank.
template <int Dim>
Layout<Dim> agreed_layout(MPI_Comm comm, const scene::Scene& scene,
                          const micrograph::Specimen<Dim>& specimen)
{
  Layout<Dim> layout;
  agree(comm, [&] { layout = make_layout(scene, specimen); });
  return layout;
}

}  // namespace

template <int Dim>
Preparation<Dim>::Preparation(MPI_Comm communicator, const scene::Scene& of,
                              std::optional<micrograph::Picture> picture)
    : scene(of),
      specimen(of, std::move(picture), share_of(communicator)),
      layout(agreed_layout(communicator, of, specimen)),
      partition(first_partition(communicator, of, specimen, layout)),
      comm(communicator),
      warnings(warnings_of(of, specimen, layout, share_of(communicator))),
      plan(make_plan(*this))
{
}

template <int Dim>
scene::Scene Preparation<Dim>::effective_scene() const
{
  scene::Scene effective = scene;
  effective.numerics.cfl = layout.cfl;
  if (is_total_lagrangian(scene.numerics)) effective.numerics.mass_scaling = mass_scaling_of(scene);
  if (is_total_lagrangian(scene.numerics) || walls_push(scene))
    effective.numerics.contact_stiffness = contact_stiffness(scene.numerics);
  if (!effective.grid.cells && !effective.grid.spacing) {
    auto& cells = effective.grid.cells.emplace();
    for (int d = 0; d < Dim; ++d) cells[std::size_t(d)] = specimen.cells()[d];
  }
  if (auto* loading = std::get_if<scene::Loading>(&effective.motion))
    loading->ramp_time = layout.piston.ramp_time;
  return effective;
}

template <int Dim>
double share_of_memory(const Preparation<Dim>& preparation)
{
  const double of_rank = preparation.plan.bytes() / ranks_of(preparation.comm);
  const double of_machine = of_rank * ranks_on_this_node(preparation.comm) / memory_limit();
  return largest_over_ranks(preparation.comm, of_machine);
}

template struct Preparation<2>;
template struct Preparation<3>;
template double share_of_memory(const Preparation<2>&);
template double share_of_memory(const Preparation<3>&);

}  // namespace mpm
