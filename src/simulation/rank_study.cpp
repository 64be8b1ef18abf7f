#include <mpm/parallel/partition_report.hpp>
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
  const int support = make_transfer<Dim>(scene.numerics, layout.per_cell)->support();
  std::string text = partition_table<Dim>(layout.geometry, ranks, partition_rules<Dim>(scene),
                                          support, start, later);
  text +=
      "imbalance: particles of the fullest rank over the mean; the others: the rank with most, ";
  text += "messages and bytes per exchange of mass, momentum and force\n";
  if (later)
    text += fmt::format("compressed: all places squeezed evenly to {:.0f} % strain\n",
                        100 * study_strain);
  return text;
}

template std::string rank_study_text(const Preparation<2>&, const std::vector<int>&);
template std::string rank_study_text(const Preparation<3>&, const std::vector<int>&);

}  // namespace mpm
