#pragma once
/// A scene from first to last step.

#include <mpm/analysis/compression_curve.hpp>
#include <mpm/simulation/history.hpp>
#include <mpm/simulation/preparation.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace mpm {

/// How the ranks worked together.
struct Cooperation {
  std::string decomposition;                         ///< at the end
  GlobalIndex migrated = 0, repartitions = 0;        ///< particles, all ranks; moves of the borders
  double messages_per_step = 0, bytes_per_step = 0;  ///< of the rank that sends most
  double waiting_seconds = 0;                        ///< of the one that waits most
  double imbalance = 1;                              ///< of particles, at the end
  double mean_imbalance = 1, mean_work_imbalance = 1;
};

/// A failure after which a run went on from its last sound state.
struct GoingBack {
  GlobalIndex failed_step;
  double failed_time;  ///< s
  std::string reason;
  GlobalIndex step;   ///< that the run went back to
  double time;        ///< s
  std::size_t lines;  ///< of the history that are left
  double step_share;  ///< of the step that the scene asks for, from there on
  std::string text() const;
};

/// The same on every rank.
struct RunResult {
  std::vector<HistoryLine> lines;
  GlobalIndex particles = 0, steps = 0;
  double end_time = 0;         ///< s
  double first_time_step = 0;  ///< s
  /// s: of the loop without its observers, of the observers, and of all from the preparation on.
  double step_seconds = 0, observer_seconds = 0, wall_seconds = 0;
  GlobalIndex largest_rank_bytes = 0;
  GlobalIndex active_nodes = 0;      ///< at the end, of all ranks; shared ones count on each
  double deepest_behind_piston = 0;  ///< m
  double largest_energy_error = 0;   ///< after 1 % strain
  Cooperation cooperation;
  /// Of a run with a piston.
  std::optional<analysis::CompressionProperties> properties;
  std::vector<std::string> warnings;  ///< of what has happened
  std::vector<GoingBack> goings_back;
  GlobalIndex repeated_steps = 0;

  double ns_per_particle_step(int ranks) const
  {
    return 1e9 * step_seconds * ranks / (double(particles) * double(steps + repeated_steps));
  }
};

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
  /// What kinds of columns there will be; before the first step.
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
  /// The run ends with an error. Returns words on what is left behind, for its message.
  virtual std::string failed(const State& /*last_sound*/) { return ""; }
};

/// Steps the scene to its end. Collective. Throws on every rank or on none.
template <int Dim>
RunResult run(const Preparation<Dim>& preparation, std::span<Observer<Dim>* const> observers);

/// The same, leaving history.csv, summary.json, the effective scene, snapshots and the picture of
/// the specimen in `folder`, and words on the terminal. Collective.
template <int Dim>
RunResult run_in_folder(const Preparation<Dim>& preparation, const std::filesystem::path& folder);

}  // namespace mpm
