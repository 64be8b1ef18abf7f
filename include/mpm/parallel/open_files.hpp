#pragma once
/// How a program ends that holds files which cannot be closed.

namespace mpm {

/// MPI's and HDF5's orderly end would close them: the session ends without it.
void leave_files_open();
bool files_are_left_open();
/// Ends all ranks with ExitStatus::file_failure, wherever the others are.
[[noreturn]] void end_with_open_files();

}  // namespace mpm
