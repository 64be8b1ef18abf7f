#include <mpm/parallel/partition_report.hpp>
#include <mpm/simulation/mesh_count.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/preparation.hpp>

#include <cmath>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Strain at which a study looks a second time.
constexpr double study_strain = 0.5;

/// The cells in which particles would be if the specimen were squeezed evenly between fixed edge
/// and piston. Wood folds layer by layer instead; where the most crowded place is on the way is not
/// known before the run.
template <int Dim>
CellVisits<Dim> squeezed(const CellVisits<Dim>& cells, const scene::Loading& loading,
                         const micrograph::Specimen<Dim>& specimen, const Layout<Dim>& layout)
{
  const int axis = axis_of(loading.piston);
  const double first = layout.padding[axis], length = specimen.cells()[axis];
  const double fixed = upper_of(loading.piston) ? first : first + length;
  return [=](const std::function<void(const IndexVec<Dim>&)>& visit) {
    cells([&](const IndexVec<Dim>& cell) {
      IndexVec<Dim> at = cell;
      const double middle = cell[axis] + 0.5;
      if (middle > first && middle < first + length)  // the load cell stays
        at[axis] = LocalIndex(std::floor(fixed + (1 - study_strain) * (middle - fixed)));
      visit(at);
    });
  };
}

template <int Dim>
PartitionReport report_on_mesh(const Preparation<Dim>& preparation, const Ownership<Dim>& ownership,
                               const CellVisits<Dim>& particles)
{
  PartitionReport report;
  report.imbalance = imbalance_of(loads_of(ownership, particles));
  for (const MeshCount& count : count_mesh(preparation.scene, preparation.specimen,
                                           preparation.layout, ownership, MPI_COMM_SELF)) {
    report.shared_nodes = std::max(report.shared_nodes, GlobalIndex(count.shared_nodes));
    report.messages = std::max(report.messages, int(count.sharers));
    report.bytes = std::max(report.bytes, GlobalIndex(sizeof(double) * Dim * count.sent_nodes));
  }
  return report;
}

template <int Dim>
Reporter<Dim> reporter_of(const Preparation<Dim>& preparation)
{
  const scene::Numerics& numerics = preparation.scene.numerics;
  if (is_total_lagrangian(numerics))
    return [&](const Ownership<Dim>& ownership, const CellVisits<Dim>& cells) {
      return report_on_mesh(preparation, ownership, cells);
    };
  return grid_reporter<Dim>(make_transfer<Dim>(numerics, preparation.layout.per_cell)->support());
}

}  // namespace

template <int Dim>
std::string rank_study_text(const Preparation<Dim>& preparation, const std::vector<int>& ranks)
{
  const scene::Scene& scene = preparation.scene;
  const micrograph::Specimen<Dim>& specimen = preparation.specimen;
  const Layout<Dim>& layout = preparation.layout;
  const CellVisits<Dim> start = [&](const std::function<void(const IndexVec<Dim>&)>& visit) {
    for_each_particle_cell(scene, specimen, layout, 0, 1, visit);
  };
  CellVisits<Dim> later;
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion))
    later = squeezed(start, *loading, specimen, layout);
  // Cells stay on their rank.
  if (is_total_lagrangian(scene.numerics)) later = nullptr;
  std::string text = partition_table<Dim>(layout.geometry, ranks, partition_rules<Dim>(scene),
                                          reporter_of(preparation), start, later);
  text +=
      "imbalance: particles of the fullest rank over the mean; the others: the rank with most, ";
  text += fmt::format("messages and bytes per exchange of {}\n",
                      is_total_lagrangian(scene.numerics) ? "forces" : "mass, momentum and force");
  if (later)
    text += fmt::format("compressed: all places squeezed evenly to {:.0f} % strain\n",
                        100 * study_strain);
  return text;
}

template std::string rank_study_text(const Preparation<2>&, const std::vector<int>&);
template std::string rank_study_text(const Preparation<3>&, const std::vector<int>&);

}  // namespace mpm
