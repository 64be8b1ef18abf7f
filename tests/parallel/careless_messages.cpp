/// Two ranks that treat messages under way as careless programs do, one breach each by name: what
/// checked_messages.cpp has to see. Without any, the sum of what has come is printed.

#include <cstdio>
#include <string>
#include <vector>

#include <mpi.h>

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  const std::string breach = argc > 1 ? argv[1] : "";
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  // Beyond what is sent before there is someone to take it.
  std::vector<double> out(1 << 16, 1.0), in(out.size());
  MPI_Request requests[2];
  MPI_Irecv(in.data(), int(in.size()), MPI_DOUBLE, 1 - rank, 0, MPI_COMM_WORLD, &requests[0]);
  MPI_Isend(out.data(), int(out.size()), MPI_DOUBLE, 1 - rank, 0, MPI_COMM_WORLD, &requests[1]);
  double early = 0;
  if (breach == "changes what is sent") out.back() = 2;
  if (breach == "writes where it receives") in.front() = 3;
  if (breach == "reads too early") early = in.front();
  if (breach != "forgets") MPI_Waitall(2, requests, MPI_STATUSES_IGNORE);
  double sum = early;
  for (const double value : in) sum += value;
  if (rank == 0) std::printf("sum %g\n", sum);
  MPI_Finalize();
  return 0;
}
