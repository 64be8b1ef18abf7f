/// A run that leaves its results in a folder and words on the terminal.

#include <mpm/core/error.hpp>
#include <mpm/micrograph/preview.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/exact_solution.hpp>
#include <mpm/simulation/failure_snapshot.hpp>
#include <mpm/simulation/progress.hpp>
#include <mpm/simulation/run_summary.hpp>
#include <mpm/simulation/snapshots.hpp>

#include <fstream>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

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
  void went_back(const GoingBack& back) override
  {
    on_rank_zero(comm_, [&] { file_->cut(back.lines); });
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
  void went_back(const GoingBack& back) override
  {
    if (!writes_) return;
    progress_.finish();
    spdlog::warn(back.text());
  }
  void finish() override
  {
    if (writes_) progress_.finish();
  }

 private:
  bool writes_, loaded_ = false;
  Progress progress_;
};

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
  ProgressWriter<Dim> progress(comm);
  FailureSnapshot<Dim> failure(preparation, folder);
  ExactSolution<Dim> exact(preparation, folder);
  std::vector<Observer<Dim>*> observers{&history, &progress, &failure, &exact};
  std::optional<Snapshots<Dim>> snapshots;
  if (asks_for_snapshots(preparation.scene))
    observers.push_back(&snapshots.emplace(preparation, folder));
  else
    on_rank_zero(comm, [&] { output::SnapshotSeries::take_down(folder, preparation.scene.name); });
  const RunResult result = run<Dim>(preparation, observers);
  on_rank_zero(comm, [&] {
    write_summary(preparation, result, exact, folder / "summary.json");
    for (const std::string& warning : result.warnings) spdlog::warn(warning);
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
