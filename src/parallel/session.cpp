#include <mpm/core/error.hpp>
#include <mpm/parallel/open_files.hpp>
#include <mpm/parallel/session.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <numeric>
#include <string>
#include <thread>

#include "petsc_check.hpp"

namespace mpm {

Session::Session(int argc, char** argv, const std::vector<std::string>& petsc_options)
{
  // Beyond a limit of size (ulimit -f) a write fails with words, instead of ending the program.
  std::signal(SIGXFSZ, SIG_IGN);
  int level = MPI_THREAD_SINGLE;  // other threads (LongStage) make no calls
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr);
  std::vector<std::string> words{argv[0]};
  words.insert(words.end(), petsc_options.begin(), petsc_options.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int count = int(words.size());
  char** list = pointers.data();
  petsc_check(PetscInitialize(&count, &list, nullptr, nullptr));
}

Session::~Session()
{
  if (files_are_left_open()) {
    std::fflush(nullptr);
    MPI_Barrier(MPI_COMM_WORLD);  // rank 0 has said what went wrong
    end_with_open_files();
  }
  PetscFinalize();
  MPI_Finalize();
}

std::string Session::petsc_version()
{
  return std::to_string(PETSC_VERSION_MAJOR) + "." + std::to_string(PETSC_VERSION_MINOR) + "." +
         std::to_string(PETSC_VERSION_SUBMINOR);
}

std::string Session::mpi_version()
{
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string full(text, length);
  return full.substr(0, full.find(','));
}

int rank_of(MPI_Comm comm)
{
  int rank;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

int ranks_of(MPI_Comm comm)
{
  int ranks;
  MPI_Comm_size(comm, &ranks);
  return ranks;
}

void sum_over_ranks(MPI_Comm comm, std::span<double> values)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, MPI_SUM, comm);
}

void sum_over_ranks(MPI_Comm comm, std::span<GlobalIndex> values)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_INT64_T, MPI_SUM, comm);
}

double largest_over_ranks(MPI_Comm comm, double value)
{
  largest_over_ranks(comm, std::span(&value, 1));
  return value;
}

void largest_over_ranks(MPI_Comm comm, std::span<double> values)
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, MPI_MAX, comm);
}

std::vector<double> joined_over_ranks(MPI_Comm comm, std::span<const double> values)
{
  std::vector<int> counts(std::size_t(ranks_of(comm))), starts(counts.size());
  const int own = int(values.size());
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  std::vector<double> all(std::size_t(starts.back()) + counts.back());
  MPI_Allgatherv(values.data(), own, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                 MPI_DOUBLE, comm);
  return all;
}

std::vector<std::vector<double>> traded_over_ranks(MPI_Comm comm,
                                                   const std::vector<std::vector<double>>& out)
{
  const std::size_t ranks = out.size();
  std::vector<int> sent(ranks), received(ranks), sent_at(ranks), received_at(ranks);
  std::vector<double> all;
  for (std::size_t r = 0; r < ranks; ++r) {
    sent_at[r] = int(all.size());
    sent[r] = int(out[r].size());
    all.insert(all.end(), out[r].begin(), out[r].end());
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm);
  int total = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    received_at[r] = total;
    total += received[r];
  }
  std::vector<double> buffer(static_cast<std::size_t>(total));
  MPI_Alltoallv(all.data(), sent.data(), sent_at.data(), MPI_DOUBLE, buffer.data(), received.data(),
                received_at.data(), MPI_DOUBLE, comm);
  std::vector<std::vector<double>> in(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    in[r].assign(buffer.begin() + received_at[r], buffer.begin() + received_at[r] + received[r]);
  return in;
}

void agree(MPI_Comm comm, const std::function<void()>& action)
{
  enum Kind : int { input, numerical, file, other, none };
  int kind = none;
  std::string text;
  GlobalIndex particle = NumericalError::none;
  try {
    action();
  } catch (const InputError& error) {
    kind = input, text = error.what();
  } catch (const NumericalError& error) {
    kind = numerical, text = error.what(), particle = error.particle();
  } catch (const FileError& error) {
    kind = file, text = error.what();
  } catch (const std::exception& error) {
    kind = other, text = error.what();
  }
  int failed = kind == none ? ranks_of(comm) : rank_of(comm);
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, comm);
  if (failed == ranks_of(comm)) return;

  GlobalIndex message[3] = {kind, GlobalIndex(text.size()), particle};
  MPI_Bcast(message, 3, MPI_INT64_T, failed, comm);
  text.resize(message[1]);
  MPI_Bcast(text.data(), int(message[1]), MPI_CHAR, failed, comm);
  switch (message[0]) {
    case input:
      throw InputError(text);
    case numerical:
      throw NumericalError(text, message[2]);
    case file:
      throw FileError(text);
    default:
      throw std::runtime_error(text);
  }
}

bool all_arrive(MPI_Comm comm, double seconds)
{
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  MPI_Request all;
  MPI_Ibarrier(comm, &all);
  for (;;) {
    int done = 0;
    MPI_Test(&all, &done, MPI_STATUS_IGNORE);
    if (done) return true;
    if (Clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void on_rank_zero(MPI_Comm comm, const std::function<void()>& action)
{
  agree(comm, [&] {
    if (rank_of(comm) == 0) action();
  });
}

}  // namespace mpm
