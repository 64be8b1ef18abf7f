/// Ranks, messages and files, without a scene.

#include <mpm/core/error.hpp>
#include <mpm/output/hdf5_file.hpp>
#include <mpm/output/hdf5_input.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <thread>
#include <vector>

#include "self_test_checks.hpp"
#include <fmt/format.h>
#include <unistd.h>

namespace mpm {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string ranks_text(int ranks)
{
  return fmt::format("{} rank{}", ranks, ranks == 1 ? "" : "s");
}

/// Any bits, not a number's alone, others for each rank and place.
double mixed(std::uint64_t rank, std::uint64_t place)
{
  std::uint64_t bits = (rank << 40) + place + 0x9e3779b97f4a7c15ULL;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return std::bit_cast<double>(bits ^ (bits >> 31));
}

bool same_bits(double a, double b)
{
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Files that other nodes have written may be some seconds late on a network's file system.
constexpr double seconds_of_patience = 10;

}  // namespace

SelfTestFolder::SelfTestFolder(MPI_Comm comm, const std::filesystem::path& within) : comm_(comm)
{
  GlobalIndex number = rank_of(comm) == 0 ? ::getpid() : 0;
  sum_over_ranks(comm, std::span(&number, 1));
  path_ = within / fmt::format("mpm_par_self_test_{}", number);
  on_rank_zero(comm, [&] {
    for (auto up = path_; !up.empty() && !std::filesystem::exists(up); up = up.parent_path())
      made_ = up;
    std::error_code failure;
    if (made_.empty() || (std::filesystem::create_directories(path_, failure), failure))
      throw FileError(
          fmt::format("{}: the folder cannot be made ({}). Name one to write in with --output.",
                      path_.string(), failure ? failure.message() : "it is there already"));
  });
}

SelfTestFolder::~SelfTestFolder()
{
  MPI_Barrier(comm_);
  std::error_code ignored;
  if (rank_of(comm_) == 0) std::filesystem::remove_all(made_, ignored);
}

std::string check_world(MPI_Comm comm, const std::optional<Launched>& launched)
{
  const int ranks = ranks_of(comm);
  if (!launched) {
    if (ranks > 1) return fmt::format("{} in it", ranks_text(ranks));
    return "1 rank, started without a launcher (mpirun -n N mpm_par --self-test)";
  }
  if (launched->ranks != ranks)
    throw std::runtime_error(fmt::format(
        "{} has started {} processes, and MPI joins {} of them: they would do the same run several "
        "times over. The launcher is of another MPI than {}, with which mpm_par was built. Start "
        "with that one's mpirun, or with srun --mpi=pmix (srun --mpi=list shows what there is).",
        launched->by, launched->ranks, ranks, Session::mpi_version()));
  return fmt::format("{}, as many as {} has started", ranks_text(ranks), launched->by);
}

std::string check_cores(MPI_Comm comm)
{
  const Places places = places_of(comm);
  const std::string nodes = fmt::format("{} node{}", places.nodes, places.nodes == 1 ? "" : "s");
  if (places.sharing == 0) return fmt::format("one or more for each rank, on {}", nodes);
  return fmt::format(
      "on {}; {} more than cores that they may use, and waiting ranks hold up all "
      "others. Ask the scheduler for a core a rank, and look at the binding.",
      nodes, ranks_text(places.sharing));
}

std::string check_messages(MPI_Comm comm)
{
  constexpr std::size_t length = 256;
  const auto ranks = std::size_t(ranks_of(comm)), own = std::size_t(rank_of(comm));
  std::vector<std::vector<double>> out(ranks);
  for (std::size_t to = 0; to < ranks; ++to)
    for (std::size_t k = 0; k < length; ++k) out[to].push_back(mixed(own, to * length + k));
  const std::vector<std::vector<double>> in = traded_over_ranks(comm, out);
  agree(comm, [&] {
    for (std::size_t from = 0; from < ranks; ++from)
      for (std::size_t k = 0; k < length; ++k)
        if (in[from].size() != length || !same_bits(in[from][k], mixed(from, own * length + k)))
          throw std::runtime_error(fmt::format(
              "rank {} has received something else than rank {} has sent. Ask the administrator to "
              "look at network and MPI.",
              own, from));
  });
  constexpr int sums = 200;
  const auto start = Clock::now();
  for (int k = 0; k < sums; ++k) largest_over_ranks(comm, double(k));
  return fmt::format("each rank with each; what all agree on takes {:.1f} us",
                     1e6 * seconds_since(start) / sums);
}

std::string check_shared_folder(MPI_Comm comm, const std::filesystem::path& folder)
{
  const std::filesystem::path file = folder / "seen";
  on_rank_zero(comm, [&] {
    std::ofstream(file) << "by all\n";
    if (!std::filesystem::exists(file))
      throw FileError(fmt::format("{}: cannot be written. Name a folder to write in with --output.",
                                  file.string()));
  });
  agree(comm, [&] {
    const auto start = Clock::now();
    while (!std::filesystem::exists(file)) {
      if (seconds_since(start) > seconds_of_patience)
        throw FileError(fmt::format(
            "{}: rank {} does not see what rank 0 has written there. Name a folder on a file "
            "system that all nodes share with --output.",
            folder.parent_path().string(), rank_of(comm)));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
  return fmt::format("{} is seen by every rank", folder.parent_path().string());
}

std::string check_parallel_file(MPI_Comm comm, const std::filesystem::path& folder)
{
  // 64 MB at most, and other lengths on each rank.
  const int ranks = ranks_of(comm);
  const auto length_of = [&](int rank) {
    return std::clamp<std::int64_t>(8'000'000 / ranks, 100, 1'000'000) + rank % 7;
  };
  std::vector<double> own;
  std::int64_t all = 0;
  for (int rank = 0; rank < ranks; ++rank) all += length_of(rank);
  for (std::int64_t k = 0; k < length_of(rank_of(comm)); ++k)
    own.push_back(mixed(std::uint64_t(rank_of(comm)), std::uint64_t(k)));
  const std::filesystem::path path = folder / "values.h5";
  const double bytes = double(all) * sizeof(double);
  const auto start = Clock::now();
  {
    output::Hdf5File file(comm, path, output::Compression::none, std::int64_t(bytes));
    file.write_rows("values", "1", 1, std::span<const double>(own));
    file.finish();
  }
  const double seconds = largest_over_ranks(comm, seconds_since(start));
  // Those of the next rank, which may have been written on another node.
  const int next = (rank_of(comm) + 1) % ranks;
  std::int64_t first = 0;
  for (int rank = 0; rank < next; ++rank) first += length_of(rank);
  agree(comm, [&] {
    const std::vector<double> found =
        output::Hdf5Input(path).read_rows<double>("values", first, length_of(next));
    for (std::size_t k = 0; k < found.size(); ++k)
      if (!same_bits(found[k], mixed(std::uint64_t(next), k)))
        throw FileError(fmt::format(
            "{}: rank {} does not read what rank {} has written. Name a folder on another file "
            "system with --output, and ask the administrator to look at this one.",
            folder.parent_path().string(), rank_of(comm), next));
  });
  return fmt::format("{:.3g} MB written by all ranks at {:.0f} MB/s, the same bits read back",
                     1e-6 * bytes, 1e-6 * bytes / seconds);
}

}  // namespace mpm
