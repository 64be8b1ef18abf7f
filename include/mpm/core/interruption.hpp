#pragma once
/// Signals by which a user or a scheduler asks a run to end.

namespace mpm {

/// From the first call to the end of the program SIGINT, SIGTERM and SIGUSR1 (which schedulers send
/// ahead of the end) are taken down instead of ending it; a second one of the same kind does what
/// it always does. Before the run too, which then ends at its first check with a state to go on
/// from; and behind it, where its results are whole: the first one must not spoil the exit status.
void watch_for_interruptions();

/// The signal that came last to this process, or 0.
int interruption_seen();

}  // namespace mpm
