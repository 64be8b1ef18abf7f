#pragma once
/// What comes out of a run beside its files.

#include <mpm/analysis/compression_curve.hpp>
#include <mpm/core/archive.hpp>
#include <mpm/simulation/history.hpp>
#include <mpm/stepping/load_balance.hpp>

#include <optional>
#include <string>
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
  /// s: of the loop without its observers, of the observers, and of all from the preparation on;
  /// those before the checkpoints that a run went on from as well.
  double step_seconds = 0, observer_seconds = 0, wall_seconds = 0;
  double core_seconds = 0;  ///< s, `step_seconds` of all ranks that were there
  GlobalIndex largest_rank_bytes = 0;
  GlobalIndex active_nodes = 0;      ///< at the end, of all ranks; shared ones count on each
  double deepest_behind_piston = 0;  ///< m
  double largest_energy_error = 0;   ///< of its lines, as they are judged
  Cooperation cooperation;
  /// Of a run with a piston.
  std::optional<analysis::CompressionProperties> properties;
  std::vector<std::string> warnings;  ///< of what has happened
  std::vector<GoingBack> goings_back;
  GlobalIndex repeated_steps = 0;

  double ns_per_particle_step() const
  {
    return 1e9 * core_seconds / (double(particles) * double(steps + repeated_steps));
  }
};

/// How far the energy balance is open at a line. Under a piston 0 up to 1 % strain, where the work
/// done is too little to judge by.
double judged_energy_error(const HistoryLine& line, bool under_a_piston);

/// Up to now. Collective.
template <int Dim>
Cooperation cooperation_of(const Formulation<Dim>& formulation, const LoadBalance<Dim>& balance);

void archive_goings_back(Archive& archive, std::vector<GoingBack>& goings_back);

}  // namespace mpm
