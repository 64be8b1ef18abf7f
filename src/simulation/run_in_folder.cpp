/// A run that leaves its results in a folder and words on the terminal.

#include <mpm/core/error.hpp>
#include <mpm/micrograph/preview.hpp>
#include <mpm/output/checksum.hpp>
#include <mpm/output/replace_file.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/scene/scene_changes.hpp>
#include <mpm/simulation/checkpoints.hpp>
#include <mpm/simulation/exact_solution.hpp>
#include <mpm/simulation/failure_snapshot.hpp>
#include <mpm/simulation/long_stage.hpp>
#include <mpm/simulation/progress.hpp>
#include <mpm/simulation/results_folder.hpp>
#include <mpm/simulation/run_summary.hpp>
#include <mpm/simulation/snapshots.hpp>

#include <array>
#include <iomanip>
#include <optional>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
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
  void resumed(const std::vector<HistoryLine>& lines) override
  {
    on_rank_zero(comm_, [&] {
      for (const HistoryLine& line : lines) file_->append(history_row(line, kind_));
    });
  }
  void archive(Archive&) override {}  // its lines are the run's

 private:
  MPI_Comm comm_;
  std::filesystem::path folder_;
  HistoryKind kind_;
  std::optional<output::HistoryFile> file_;
};

/// What a run says of itself before its first line. The folder stays as it was left until the run
/// is there that goes on, or that takes the place of another one.
template <int Dim>
class FolderWriter final : public Observer<Dim> {
 public:
  FolderWriter(const Preparation<Dim>& preparation, const RunRequest& request,
               ResultsFolder& results, const std::string& effective_scene)
      : preparation_(preparation),
        request_(request),
        results_(results),
        effective_scene_(effective_scene)
  {
  }
  void start(const HistoryKind&) override
  {
    on_rank_zero(preparation_.comm, [&] {
      const std::filesystem::path& folder = request_.results;
      if (request_.restart)
        results_.go_on();
      else
        results_.start_anew(request_.overwrite);
      output::replace_file(folder / "scene.yaml", effective_scene_);
      micrograph::write_preview(preparation_.specimen, folder / "specimen.png");
    });
  }
  void archive(Archive&) override {}

 private:
  const Preparation<Dim>& preparation_;
  const RunRequest& request_;
  ResultsFolder& results_;
  const std::string& effective_scene_;
};

/// How far the run is, on rank 0's terminal; warnings alone if it is quiet.
template <int Dim>
class ProgressWriter final : public Observer<Dim> {
 public:
  ProgressWriter(MPI_Comm comm, bool quiet) : writes_(rank_of(comm) == 0), quiet_(quiet)
  {
    if (writes_ && !quiet_) start_.emplace("placing the particles");
  }
  void start(const HistoryKind& kind) override
  {
    start_.reset();
    loaded_ = kind.piston;
  }
  void line(const typename Observer<Dim>::State& state, const HistoryLine& line) override
  {
    const long steps = long(state.formulation.steps());
    if (writes_ && !quiet_)
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
  void archive(Archive&) override {}

 private:
  bool writes_, quiet_, loaded_ = false;
  std::optional<LongStage> start_;
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
  if (found.toe)
    fmt::print("{:<24} {:8.0f} MPa from {:.2f} %\n", "modulus beyond the toe",
               1e-6 * found.toe->modulus, 100 * found.toe->strain);
  point("onset of buckling", found.buckling);
  point("onset of densification", found.densification);
}

std::string effective_scene_text(const scene::Scene& effective)
{
  std::ostringstream text;
  scene::write_effective_scene(text, effective);
  return text.str();
}

/// A line of YAML each.
std::string checksums_of(std::span<const std::filesystem::path> files)
{
  std::ostringstream lines;
  for (const std::filesystem::path& file : files)
    lines << std::quoted("checksum of " + file.filename().string()) << ": "
          << output::checksum_of(file) << '\n';
  return lines.str();
}

/// The state to go on from, and what is wrong with newer ones.
template <int Dim>
std::unique_ptr<Archive> take_up(const Preparation<Dim>& preparation, const RunRequest& request,
                                 const std::string& record)
{
  const MPI_Comm comm = preparation.comm;
  LoadedState loaded = load_state(comm, CheckpointFolder(request.results), request.checkpoint);
  std::string before;
  loaded.state->text(checkpoint_record, before);
  agree(comm, [&] {
    const std::vector<std::string> changes = scene::changes_that_matter(before, record);
    if (changes.empty()) return;
    throw InputError(fmt::format("{}: is of another scene: {}. Go on with the scene as it was.",
                                 loaded.file.string(), fmt::join(changes, "; ")));
  });
  on_rank_zero(comm, [&] {
    for (const std::string& reason : loaded.passed_over) spdlog::warn(reason);
    if (request.quiet) return;
    const std::string others =
        loaded.ranks == ranks_of(comm)
            ? ""
            : fmt::format(" of {} rank{}", loaded.ranks, loaded.ranks == 1 ? "" : "s");
    fmt::print("goes on from {}{}\n", loaded.file.string(), others);
  });
  return std::move(loaded.state);
}

/// What the run goes on from, if it does, and that the folder is free for it.
template <int Dim>
Continuation begin_in_folder(const Preparation<Dim>& preparation, const RunRequest& request,
                             const ResultsFolder& results, const std::string& effective_scene)
{
  Continuation continuation{.results = request.results, .time_limit = request.time_limit};
  agree(preparation.comm,
        [&] { continuation.record = effective_scene + checksums_of(request.pictures); });
  on_rank_zero(preparation.comm, [&] {
    if (request.checkpoint) results.expect_same_run(*request.checkpoint);
    if (request.restart) return;
    std::vector<std::filesystem::path> inputs = request.pictures;
    inputs.push_back(request.scene);
    results.expect_no_input(inputs, effective_scene);
    if (!request.overwrite) results.expect_no_run();
  });
  if (request.restart) continuation.state = take_up(preparation, request, continuation.record);
  return continuation;
}

}  // namespace

template <int Dim>
RunResult run_in_folder(const Preparation<Dim>& preparation, const RunRequest& request)
{
  const MPI_Comm comm = preparation.comm;
  const std::filesystem::path& folder = request.results;
  const std::string effective_scene = effective_scene_text(preparation.effective_scene());
  ResultsFolder results(folder);
  Continuation continuation = begin_in_folder(preparation, request, results, effective_scene);
  FolderWriter<Dim> writer(preparation, request, results, effective_scene);
  HistoryWriter<Dim> history(comm, folder);
  ProgressWriter<Dim> progress(comm, request.quiet);
  FailureSnapshot<Dim> failure(preparation, folder);
  ExactSolution<Dim> exact(preparation, folder);
  Snapshots<Dim> snapshots(preparation, folder);
  const std::array<Observer<Dim>*, 6> observers{&writer,  &history, &progress,
                                                &failure, &exact,   &snapshots};
  const RunResult result = run<Dim>(preparation, observers, std::move(continuation));
  on_rank_zero(comm, [&] {
    write_summary(preparation, result, exact, folder / "summary.json");
    for (const std::string& warning : result.warnings) spdlog::warn(warning);
    if (request.quiet) return;
    if (result.properties) print(*result.properties);
    exact.print();
    fmt::print(
        "{} steps in {:.1f} s, {:.1f} ns per particle and step, energy error {:.2f} %\n"
        "results in {}\n",
        result.steps, result.step_seconds + result.observer_seconds, result.ns_per_particle_step(),
        100 * result.lines.back().energy_error, folder.string());
  });
  return result;
}

template RunResult run_in_folder(const Preparation<2>&, const RunRequest&);
template RunResult run_in_folder(const Preparation<3>&, const RunRequest&);

}  // namespace mpm
