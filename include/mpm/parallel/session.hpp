#pragma once
/// Start and end of MPI and PETSc, and what all ranks agree on.

#include <mpm/core/types.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <mpi.h>

namespace mpm {

/// MPI and PETSc, for the life of the object.
class Session {
 public:
  /// `petsc_options`: what the command line left for PETSc.
  Session(int argc, char** argv, const std::vector<std::string>& petsc_options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  static std::string petsc_version();
  static std::string mpi_version();
};

int rank_of(MPI_Comm comm);
int ranks_of(MPI_Comm comm);

// Collective; every rank gets the result.
void sum_over_ranks(MPI_Comm comm, std::span<double> values);
void sum_over_ranks(MPI_Comm comm, std::span<GlobalIndex> values);
double largest_over_ranks(MPI_Comm comm, double value);
void largest_over_ranks(MPI_Comm comm, std::span<double> values);
/// All ranks' values one after the other.
std::vector<double> joined_over_ranks(MPI_Comm comm, std::span<const double> values);

/// `out`: this rank's values for each rank. Returns each rank's for this one.
std::vector<std::vector<double>> traded_over_ranks(MPI_Comm comm,
                                                   const std::vector<std::vector<double>>& out);

/// Runs `action` on every rank; if it throws anywhere, every rank throws the error of the lowest
/// rank that failed. Collective: keeps ranks out of collectives that a failed one never reaches.
/// `action` itself must not contain collectives that some ranks could miss.
void agree(MPI_Comm comm, const std::function<void()>& action);
/// The same for what rank 0 does alone.
void on_rank_zero(MPI_Comm comm, const std::function<void()>& action);

/// Whether all ranks come here within so many seconds, as they do after an error that they have
/// agreed on; after one that this rank alone has met the others may wait for it elsewhere.
/// `comm` serves for nothing else.
bool all_arrive(MPI_Comm comm, double seconds);

}  // namespace mpm
