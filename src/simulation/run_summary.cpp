#include <mpm/analysis/compression_summary.hpp>
#include <mpm/output/summary.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/provenance.hpp>
#include <mpm/simulation/run_summary.hpp>

#include <optional>

namespace mpm {

namespace {

template <int Dim>
void describe(const Preparation<Dim>& preparation, output::Summary& summary)
{
  const auto& specimen = preparation.specimen;
  summary.set("name", preparation.scene.name);
  summary.set("title", preparation.scene.title);
  summary.set("dimensions", Dim);
  summary.set("relative_density", specimen.densities().front().value);
  if (const auto& picture = specimen.picture()) {
    summary.set("picture_relative_density", picture->density);
    // With bands there is none, and where walls were grown it is no gray of the picture.
    const bool is_gray = picture->threshold != 0 && picture->growth == 0;
    summary.set("threshold", is_gray ? std::optional(picture->threshold) : std::nullopt);
    summary.set("wall_growth", picture->growth);
    summary.set("removed_locations", picture->removed);
  }
  summary.set("bulk_density", specimen.densities().front().bulk_density);
  for (std::size_t k = 1; k < specimen.densities().size(); ++k)
    summary.section("windows").set(specimen.densities()[k].window, specimen.densities()[k].value);
  std::vector<std::int64_t> cells;
  for (int d = 0; d < Dim; ++d) cells.push_back(specimen.cells()[d]);
  summary.set("cells", std::move(cells));
  std::vector<double> size;
  for (int d = 0; d < Dim; ++d) size.push_back(specimen.size()[d]);
  summary.set("size", std::move(size));
}

void describe(const Cooperation& cooperation, output::Summary& summary)
{
  summary.set("decomposition", cooperation.decomposition);
  summary.set("migrated", cooperation.migrated);
  summary.set("repartitions", cooperation.repartitions);
  summary.set("messages_per_step", cooperation.messages_per_step);
  summary.set("bytes_per_step", cooperation.bytes_per_step);
  summary.set("imbalance", cooperation.imbalance);
  summary.set("mean_imbalance", cooperation.mean_imbalance);
  summary.set("mean_work_imbalance", cooperation.mean_work_imbalance);
  summary.set("waiting_seconds", cooperation.waiting_seconds);
}

void describe_curve(const analysis::CompressionProperties& found, output::Summary& summary)
{
  const auto set = [&](const std::string& what, const std::optional<analysis::CurvePoint>& p) {
    summary.set(what + "_stress", p ? std::optional(p->stress) : std::nullopt);
    summary.set(what + "_strain", p ? std::optional(p->strain) : std::nullopt);
  };
  summary.set("modulus", found.modulus);
  set("buckling", found.buckling);
  set("densification", found.densification);
  analysis::describe(found, summary.section("compression"));
}

void describe(const std::vector<GoingBack>& goings_back, GlobalIndex repeated_steps,
              output::Summary& summary)
{
  summary.set("recoveries", goings_back.size());
  if (goings_back.empty()) return;
  output::Summary& recovery = summary.section("recovery");
  recovery.set("step_share", goings_back.back().step_share);
  recovery.set("repeated_steps", repeated_steps);
  std::vector<std::string> reports;
  for (const GoingBack& back : goings_back) reports.push_back(back.text());
  recovery.set("reports", std::move(reports));
}

}  // namespace

template <int Dim>
void write_summary(const Preparation<Dim>& preparation, const RunResult& result,
                   const ExactSolution<Dim>& exact, const std::filesystem::path& file)
{
  output::Summary summary;
  describe(preparation, summary);
  const int ranks = ranks_of(preparation.comm);
  const HistoryLine& last = result.lines.back();
  summary.set("particles", result.particles);
  summary.set("ranks", ranks);
  summary.set("steps", result.steps);
  summary.set("time_step", result.first_time_step);
  summary.set("end_time", result.end_time);
  if (result.properties) summary.set("ramp_time", preparation.layout.piston.ramp_time);
  summary.set("strain", last.strain);
  summary.set("wall_seconds", result.wall_seconds);
  summary.set("loop_seconds", result.step_seconds + result.observer_seconds);
  summary.set("output_seconds", result.observer_seconds);
  summary.set("ns_per_particle_step", result.ns_per_particle_step());
  summary.set("largest_rank_bytes", result.largest_rank_bytes);
  summary.set("active_nodes", result.active_nodes);
  describe(result.cooperation, summary);
  summary.set("energy_error", last.energy_error);
  summary.set("largest_energy_error", result.largest_energy_error);
  if (cells_may_fail(preparation.scene)) {
    summary.set("failed_cells", last.failed_cells);
    summary.set("failed_energy", last.failed_energy);
  }
  if (result.properties) {
    describe_curve(*result.properties, summary);
    summary.set("deepest_behind_piston", result.deepest_behind_piston);
  }
  exact.describe(summary);
  std::vector<std::string> warnings = preparation.warnings;
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  summary.set("warnings", warnings);
  describe(result.goings_back, result.repeated_steps, summary);
  describe(preparation.plan, summary.section("plan"));
  for (const auto& [what, version] : provenance()) summary.section("provenance").set(what, version);
  summary.section("provenance").set("scene", preparation.scene.file.string());
  summary.write(file);
}

template void write_summary(const Preparation<2>&, const RunResult&, const ExactSolution<2>&,
                            const std::filesystem::path&);
template void write_summary(const Preparation<3>&, const RunResult&, const ExactSolution<3>&,
                            const std::filesystem::path&);

}  // namespace mpm
