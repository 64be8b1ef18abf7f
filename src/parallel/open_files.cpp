#include <mpm/core/error.hpp>
#include <mpm/parallel/open_files.hpp>
#include <mpm/parallel/session.hpp>

#include <cstdio>
#include <cstdlib>

namespace mpm {

namespace {
bool left_open = false;
}

void leave_files_open()
{
  left_open = true;
}

bool files_are_left_open()
{
  return left_open;
}

void end_with_open_files()
{
  std::fflush(nullptr);
  if (ranks_of(MPI_COMM_WORLD) > 1) MPI_Abort(MPI_COMM_WORLD, int(ExitStatus::file_failure));
  std::_Exit(int(ExitStatus::file_failure));
}

}  // namespace mpm
