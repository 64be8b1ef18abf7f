#pragma once
/// How far a run is, for people: one line that is rewritten on a terminal, plain lines elsewhere.

#include <chrono>
#include <optional>
#include <string>

namespace mpm {

struct ProgressState {
  double fraction = 0;  ///< of the run
  long step = 0;
  double time = 0;  ///< s
  double strain = 0;
  double stress = 0;        ///< Pa, piston
  bool loaded = false;      ///< strain and stress mean something
  long particle_steps = 0;  ///< done so far, all ranks
};

/// Used on one rank.
class Progress {
 public:
  Progress();
  /// Prints if it is time to.
  void show(const ProgressState& state);
  void finish();

 private:
  std::string line(const ProgressState& state, double seconds) const;

  using Clock = std::chrono::steady_clock;
  std::optional<ProgressState> first_;  ///< a run that goes on has come this far before
  Clock::time_point start_, last_;      ///< when that was shown, and the last one
  bool terminal_;
  double next_fraction_ = 0;
  bool open_line_ = false;
};

}  // namespace mpm
