#include <mpm/core/error.hpp>
#include <mpm/output/agreement.hpp>

namespace mpm::output {

void throw_if_any(MPI_Comm comm, const std::string& problem)
{
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const int mine = problem.empty() ? ranks : rank;
  int speaker = ranks;
  MPI_Allreduce(&mine, &speaker, 1, MPI_INT, MPI_MIN, comm);
  if (speaker == ranks) return;

  std::string text = problem;
  int length = int(text.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, comm);
  text.resize(std::size_t(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, speaker, comm);
  throw FileError(text);
}

void on_rank_zero(MPI_Comm comm, const std::function<void()>& action)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string problem;
  if (rank == 0) {
    try {
      action();
    } catch (const FileError& error) {
      problem = error.what();
    }
  }
  throw_if_any(comm, problem);
}

}  // namespace mpm::output
