#pragma once
/// Errors of one rank made known to all, so that a collective sequence ends on every rank at once.

#include <functional>
#include <string>

#include <mpi.h>

namespace mpm::output {

/// Collective. Throws FileError with the lowest failing rank's problem on every rank unless all
/// problems are empty.
void throw_if_any(MPI_Comm comm, const std::string& problem);

/// Collective. Rank 0 acts; a FileError it throws is thrown on every rank.
void on_rank_zero(MPI_Comm comm, const std::function<void()>& action);

}  // namespace mpm::output
