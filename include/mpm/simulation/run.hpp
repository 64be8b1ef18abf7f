#pragma once
/// A scene from first to last step.

#include <mpm/core/archive.hpp>
#include <mpm/simulation/history.hpp>
#include <mpm/simulation/preparation.hpp>
#include <mpm/simulation/run_result.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mpm {

/// Looks on while a run goes; called on every rank, so that it may be collective.
template <int Dim>
class Observer {
 public:
  struct State {
    Formulation<Dim>& formulation;
    double strain;    ///< 0 without a piston
    double fraction;  ///< of the run
  };
  virtual ~Observer() = default;
  /// What kinds of columns there will be; before the first step, and behind the archive that a run
  /// goes on from.
  virtual void start(const HistoryKind&) {}
  /// Before the first step and after each.
  virtual void look(const State&) {}
  /// When a line of the history has been measured.
  virtual void line(const State&, const HistoryLine&) {}
  virtual void finish() {}

  /// Whether the last sound state is kept for this one's `failed`.
  virtual bool wants_last_sound_state() const { return false; }
  /// The present state is the one to go back to.
  virtual void kept() {}
  /// The run is where it was when a state was kept last: what came after it has not been.
  virtual void went_back(const GoingBack&) {}
  /// What the observer goes on from, with the run: all that it has gathered, or nothing.
  virtual void archive(Archive&) = 0;
  /// The run goes on from a checkpoint, in place of its start, with these lines behind it.
  virtual void resumed(const std::vector<HistoryLine>& /*lines*/) {}
  /// The run ends with an error. Returns words on what is left behind, for its message.
  virtual std::string failed(const State& /*last_sound*/) { return ""; }
};

/// Where a run leaves its checkpoints, what it goes on from, and when it has to end.
struct Continuation {
  std::filesystem::path results;       ///< folder
  std::unique_ptr<Archive> state{};    ///< to be loaded; none: from the start
  std::string record{};                ///< words on what the run is of, for its checkpoints
  std::optional<double> time_limit{};  ///< s, of wall time
};

/// Steps the scene to its end. Collective. Throws on every rank or on none; Interruption, with a
/// checkpoint, where a signal or the time limit ends it.
template <int Dim>
RunResult run(const Preparation<Dim>& preparation, std::span<Observer<Dim>* const> observers,
              Continuation continuation);

/// What the command line asks of a run.
struct RunRequest {
  std::filesystem::path results;  ///< folder
  bool restart = false;           ///< from the newest checkpoint there, or from `checkpoint`
  std::optional<std::filesystem::path> checkpoint{};
  bool overwrite = false;              ///< what another run has left there is of no more use
  std::optional<double> time_limit{};  ///< s
  std::filesystem::path scene{};       ///< the file that it has been read from
  std::vector<std::filesystem::path> pictures{};  ///< that it has read
  bool quiet = false;                             ///< warnings alone on the terminal
};

/// The same, leaving history.csv, summary.json, the effective scene, snapshots and the picture of
/// the specimen in the folder, and words on the terminal. Collective.
template <int Dim>
RunResult run_in_folder(const Preparation<Dim>& preparation, const RunRequest& request);

}  // namespace mpm
