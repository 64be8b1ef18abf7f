#pragma once
/// Signals by which a user or a scheduler asks a run to end.

namespace mpm {

/// While it lives SIGINT, SIGTERM and SIGUSR1 (which schedulers send ahead of the end) are taken
/// down instead of ending the program; a second one of the same kind does what it always does.
class InterruptionSignals {
 public:
  InterruptionSignals();
  ~InterruptionSignals();
  InterruptionSignals(const InterruptionSignals&) = delete;
  InterruptionSignals& operator=(const InterruptionSignals&) = delete;

  /// The signal that came last to this process, or 0.
  static int seen();
};

}  // namespace mpm
