#include <mpm/parallel/partition_report.hpp>
#include <mpm/simulation/run.hpp>

#include <cmath>

#include "placement.hpp"
#include <fmt/format.h>

namespace mpm {

namespace {

/// Strain at which a study looks a second time.
constexpr double study_strain = 0.5;

/// The cells in which particles would be if the specimen were squeezed evenly between fixed edge
/// and piston. Wood folds layer by layer instead; where the most crowded place is on the way is not
/// known before the run.
CellVisits<2> squeezed(const CellVisits<2>& cells, const scene::Loading& loading,
                       const micrograph::SpecimenModel& specimen, const Layout& layout)
{
  const int axis = axis_of(loading.piston);
  const double first = layout.padding[axis], length = specimen.cells[axis];
  const double fixed = upper_of(loading.piston) ? first : first + length;
  return [=](const std::function<void(const IndexVec<2>&)>& visit) {
    cells([&](const IndexVec<2>& cell) {
      IndexVec<2> at = cell;
      const double middle = cell[axis] + 0.5;
      if (middle > first && middle < first + length)  // the load cell stays
        at[axis] = LocalIndex(std::floor(fixed + (1 - study_strain) * (middle - fixed)));
      visit(at);
    });
  };
}

}  // namespace

std::string rank_study_text(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
                            const Layout& layout, const std::vector<int>& ranks)
{
  const CellVisits<2> start = [&](const std::function<void(const IndexVec<2>&)>& visit) {
    for_each_particle_cell(scene, specimen, layout, {}, visit);
  };
  CellVisits<2> later;
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion))
    later = squeezed(start, *loading, specimen, layout);
  const int support = make_transfer<2>(scene.numerics.shape_function, scene.numerics.scheme,
                                       specimen.particles_per_cell)
                          ->support();
  std::string text =
      partition_table<2>(layout.geometry, ranks, partition_rules(scene), support, start, later);
  text +=
      "imbalance: particles of the fullest rank over the mean; the others: the rank with most, ";
  text += "messages and bytes per exchange of mass, momentum and force\n";
  if (later)
    text += fmt::format("compressed: all places squeezed evenly to {:.0f} % strain\n",
                        100 * study_strain);
  return text;
}

}  // namespace mpm
