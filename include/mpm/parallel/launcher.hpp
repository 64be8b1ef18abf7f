#pragma once
/// What started the ranks, and where they are.

#include <optional>
#include <string>

#include <mpi.h>

namespace mpm {

/// What a launcher tells each process that it starts.
struct Launched {
  int ranks, rank;
  std::string by;  ///< words for people
};

/// From the environment, before MPI has started, which may write there itself.
std::optional<Launched> launched();

struct Places {
  int nodes;
  int sharing;  ///< ranks that have to share a core with others, at least
};

/// Collective.
Places places_of(MPI_Comm comm);
/// This one with them. Collective.
int ranks_on_this_node(MPI_Comm comm);

}  // namespace mpm
