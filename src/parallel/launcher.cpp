#include <mpm/parallel/launcher.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include <sched.h>

namespace mpm {

std::optional<Launched> launched()
{
  struct Names {
    const char *ranks, *rank, *by;
  };
  // Inside a Slurm job mpirun's own numbers hold: Slurm's are then of the daemons that it starts.
  constexpr std::array names{
      Names{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "Open MPI's mpirun"},
      Names{"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK", "MVAPICH's mpirun"},
      Names{"PMI_SIZE", "PMI_RANK", "the launcher (mpirun of MPICH or Intel MPI, or srun)"},
      Names{"SLURM_STEP_NUM_TASKS", "SLURM_PROCID", "srun"}};
  for (const Names& name : names) {
    const char *ranks = std::getenv(name.ranks), *rank = std::getenv(name.rank);
    if (ranks && rank) return Launched{std::atoi(ranks), std::atoi(rank), name.by};
  }
  return std::nullopt;
}

namespace {

/// To be freed.
MPI_Comm node_of(MPI_Comm comm)
{
  MPI_Comm node;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  return node;
}

}  // namespace

Places places_of(MPI_Comm comm)
{
  MPI_Comm node = node_of(comm);
  cpu_set_t cores;
  CPU_ZERO(&cores);
  // Fails where there are more cores than the set has room for: as many as that, then.
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) std::memset(&cores, 0xff, sizeof cores);
  MPI_Allreduce(MPI_IN_PLACE, &cores, sizeof cores, MPI_BYTE, MPI_BOR, node);
  const int first = rank_of(node) == 0 ? 1 : 0, beyond = ranks_of(node) - CPU_COUNT(&cores);
  std::array<GlobalIndex, 2> sums{first, first * std::max(beyond, 0)};
  MPI_Comm_free(&node);
  sum_over_ranks(comm, sums);
  return {int(sums[0]), int(sums[1])};
}

int ranks_on_this_node(MPI_Comm comm)
{
  MPI_Comm node = node_of(comm);
  const int ranks = ranks_of(node);
  MPI_Comm_free(&node);
  return ranks;
}

}  // namespace mpm
