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

/// The same on every rank.
struct RunResult {
  std::vector<HistoryLine> lines;
  GlobalIndex particles = 0, steps = 0;
  double end_time = 0;         ///< s
  double first_time_step = 0;  ///< s
  /// s: of the loop without its observers, of the observers, and of all from the preparation on.
  double step_seconds = 0, observer_seconds = 0, wall_seconds = 0;
  GlobalIndex largest_rank_bytes = 0;
  double deepest_behind_piston = 0;  ///< m
  double largest_energy_error = 0;   ///< after 1 % strain
  Cooperation cooperation;
  /// Of a run with a piston.
  std::optional<analysis::CompressionProperties> properties;

  double ns_per_particle_step(int ranks) const
  {
    return 1e9 * step_seconds * ranks / (double(particles) * double(steps));
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
};

/// Steps the scene to its end. Collective. Throws on every rank or on none.
template <int Dim>
RunResult run(const Preparation<Dim>& preparation, std::span<Observer<Dim>* const> observers);

/// The same, leaving history.csv, summary.json, the effective scene, snapshots and the picture of
/// the specimen in `folder`, and words on the terminal. Collective.
template <int Dim>
RunResult run_in_folder(const Preparation<Dim>& preparation, const std::filesystem::path& folder);

}  // namespace mpm
