/// A run that leaves its results in a folder and words on the terminal.

#include <mpm/analysis/compression_summary.hpp>
#include <mpm/core/error.hpp>
#include <mpm/micrograph/preview.hpp>
#include <mpm/output/summary.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/exact_solution.hpp>
#include <mpm/simulation/progress.hpp>
#include <mpm/simulation/provenance.hpp>
#include <mpm/simulation/snapshots.hpp>

#include <fstream>

#include <fmt/format.h>

namespace mpm {

namespace {

/// history.csv, by rank 0.
template <int Dim>
class HistoryWriter final : public Observer<Dim> {
 public:
  HistoryWriter(MPI_Comm comm, const std::filesystem::path& folder) : comm_(comm), folder_(folder)
  {
  }
  void start(const HistoryKind& kind) override
  {
    kind_ = kind;
    on_rank_zero(comm_, [&] { file_.emplace(folder_ / "history.csv", history_columns(kind)); });
  }
  void line(const typename Observer<Dim>::State&, const HistoryLine& line) override
  {
    on_rank_zero(comm_, [&] { file_->append(history_row(line, kind_)); });
  }

 private:
  MPI_Comm comm_;
  std::filesystem::path folder_;
  HistoryKind kind_;
  std::optional<output::HistoryFile> file_;
};

/// How far the run is, on rank 0's terminal.
template <int Dim>
class ProgressWriter final : public Observer<Dim> {
 public:
  explicit ProgressWriter(MPI_Comm comm) : writes_(rank_of(comm) == 0) {}
  void start(const HistoryKind& kind) override { loaded_ = kind.piston; }
  void line(const typename Observer<Dim>::State& state, const HistoryLine& line) override
  {
    const long steps = long(state.formulation.steps());
    if (writes_)
      progress_.show({state.fraction, steps, line.time, line.strain, line.stress(), loaded_,
                      steps * long(line.particles)});
  }
  void finish() override
  {
    if (writes_) progress_.finish();
  }

 private:
  bool writes_, loaded_ = false;
  Progress progress_;
};

template <int Dim>
void describe(const Preparation<Dim>& preparation, output::Summary& summary)
{
  const auto& specimen = preparation.specimen;
  summary.set("name", preparation.scene.name);
  summary.set("title", preparation.scene.title);
  summary.set("dimensions", Dim);
  summary.set("relative_density", specimen.densities().front().value);
  if (specimen.picture()) {
    summary.set("picture_relative_density", specimen.picture()->density);
    summary.set("removed_locations", specimen.picture()->removed);
  }
  summary.set("bulk_density", specimen.densities().front().bulk_density);
  for (std::size_t k = 1; k < specimen.densities().size(); ++k)
    summary.section("windows").set(specimen.densities()[k].window, specimen.densities()[k].value);
  std::vector<std::int64_t> cells;
  for (int d = 0; d < Dim; ++d) cells.push_back(specimen.cells()[d]);
  summary.set("cells", std::move(cells));
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
  summary.set("ns_per_particle_step", result.ns_per_particle_step(ranks));
  summary.set("largest_rank_bytes", result.largest_rank_bytes);
  describe(result.cooperation, summary);
  summary.set("energy_error", last.energy_error);
  summary.set("largest_energy_error", result.largest_energy_error);
  if (result.properties) {
    describe_curve(*result.properties, summary);
    summary.set("deepest_behind_piston", result.deepest_behind_piston);
  }
  exact.describe(summary);
  for (const auto& [what, version] : provenance()) summary.section("provenance").set(what, version);
  summary.section("provenance").set("scene", preparation.scene.file.string());
  summary.write(file);
}

void print(const analysis::CompressionProperties& found)
{
  const auto point = [](const char* what, const std::optional<analysis::CurvePoint>& p) {
    if (p)
      fmt::print("{:<24} {:8.1f} MPa at {:.2f} %\n", what, 1e-6 * p->stress, 100 * p->strain);
    else
      fmt::print("{:<24}        - (not reached or not distinct)\n", what);
  };
  if (found.modulus) fmt::print("{:<24} {:8.0f} MPa\n", "modulus", 1e-6 * *found.modulus);
  point("onset of buckling", found.buckling);
  point("onset of densification", found.densification);
}

template <int Dim>
void make_folder(const Preparation<Dim>& preparation, const std::filesystem::path& folder)
{
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw FileError(fmt::format("{}: cannot make this folder ({}). Choose another with --output.",
                                folder.string(), failure.message()));
  std::ofstream effective(folder / "scene.yaml");
  scene::write_effective_scene(effective, preparation.effective_scene());
  if (!effective.flush())
    throw FileError(fmt::format("{}: cannot write", (folder / "scene.yaml").string()));
  micrograph::write_preview(preparation.specimen, folder / "specimen.png");
}

}  // namespace

template <int Dim>
RunResult run_in_folder(const Preparation<Dim>& preparation, const std::filesystem::path& folder)
{
  const MPI_Comm comm = preparation.comm;
  on_rank_zero(comm, [&] { make_folder(preparation, folder); });
  HistoryWriter<Dim> history(comm, folder);
  Snapshots<Dim> snapshots(preparation, folder);
  ProgressWriter<Dim> progress(comm);
  ExactSolution<Dim> exact(preparation, folder);
  const std::array<Observer<Dim>*, 4> observers{&history, &progress, &snapshots, &exact};
  const RunResult result = run<Dim>(preparation, observers);
  on_rank_zero(comm, [&] {
    write_summary(preparation, result, exact, folder / "summary.json");
    if (result.properties) print(*result.properties);
    exact.print();
    fmt::print(
        "{} steps in {:.1f} s, {:.1f} ns per particle and step, energy error {:.2f} %\n"
        "results in {}\n",
        result.steps, result.step_seconds + result.observer_seconds,
        result.ns_per_particle_step(ranks_of(comm)), 100 * result.lines.back().energy_error,
        folder.string());
  });
  return result;
}

template RunResult run_in_folder(const Preparation<2>&, const std::filesystem::path&);
template RunResult run_in_folder(const Preparation<3>&, const std::filesystem::path&);

}  // namespace mpm
