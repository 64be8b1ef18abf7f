/// The state of all ranks in one file, and back to the last bit; files that are not whole.

#include <mpm/core/error.hpp>
#include <mpm/output/state_file.hpp>
#include <mpm/parallel/session.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <mpi.h>
#include <semaphore.h>
#include <unistd.h>

namespace mpm::output {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

int rank()
{
  return rank_of(MPI_COMM_WORLD);
}

std::filesystem::path fresh_file(const std::string& name)
{
  const std::filesystem::path folder = MPM_SCRATCH_DIRECTORY;
  const auto file = folder / (name + "_" + std::to_string(ranks_of(MPI_COMM_WORLD)) + ".h5");
  if (rank() == 0) {
    std::filesystem::create_directories(folder);
    std::filesystem::remove(file);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return file;
}

/// Other lengths on each rank, none on the second; every kind; numbers that are not numbers.
MemoryArchive some_state()
{
  MemoryArchive state;
  const auto count = std::size_t(rank() == 1 ? 0 : 700 + 13 * rank());
  std::vector<double> reals;
  std::vector<std::int64_t> wholes;
  for (std::size_t k = 0; k < count; ++k) {
    reals.push_back(1.0 / (double(k) + 3.0 * rank()));
    wholes.push_back(std::int64_t(k) * 1'000'000'007 - rank());
  }
  if (count > 3) {
    reals[0] = std::numeric_limits<double>::quiet_NaN();
    reals[1] = -0.0;
    reals[2] = std::numeric_limits<double>::denorm_min();
  }
  state.put("body0/motion/velocity", reals);
  state.put("body0/id", wholes);
  state.put("nobody/has", std::vector<double>{});
  state.put("words", "rank " + std::to_string(rank()) + "\nß");
  state.put("time", std::vector{0.1 * rank()});
  return state;
}

/// What reading says, which is the same on every rank.
std::string refusal(const std::filesystem::path& file)
{
  try {
    ranks_of_state(file);
    read_state(MPI_COMM_WORLD, file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(StateFile, BringsBackEveryBitOfEveryRank)
{
  const auto file = fresh_file("whole");
  const MemoryArchive state = some_state();
  write_state(MPI_COMM_WORLD, file, state);
  EXPECT_EQ(ranks_of_state(file), ranks_of(MPI_COMM_WORLD));
  EXPECT_THAT(differences(read_state(MPI_COMM_WORLD, file), state), IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST(StateFile, ReplacesAnotherOne)
{
  const auto file = fresh_file("twice");
  write_state(MPI_COMM_WORLD, file, some_state());
  MemoryArchive second;
  second.put("time", std::vector{7.0 + rank()});
  write_state(MPI_COMM_WORLD, file, second);
  EXPECT_THAT(differences(read_state(MPI_COMM_WORLD, file), second), IsEmpty());
}

/// Names beside it of what is not finished.
std::vector<std::string> parts_of(const std::filesystem::path& file)
{
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(file.stem().string() + '.') && name.ends_with(".part"))
      found.push_back(name);
  }
  return found;
}

/// A run that is killed while Open MPI opens a file leaves a semaphore taken for every later run on
/// that machine that opens a file of the same last name, in whatever folder.
TEST(StateFile, WhatAKilledRunHeldStopsNoLaterOne)
{
  const auto file = fresh_file("held");
  static const std::string name = "OMPIO_" + file.filename().string() + ".part";
  if (rank() == 0) {
    for (const std::string& part : parts_of(file))  // of a run that waited for ever
      std::filesystem::remove(file.parent_path() / part);
    ASSERT_NE(sem_open(name.c_str(), O_CREAT, 0600, 0), SEM_FAILED);
    std::signal(SIGALRM, [](int) {  // instead of waiting for ever
      sem_unlink(name.c_str());
      std::_Exit(1);
    });
    alarm(30);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  write_state(MPI_COMM_WORLD, file, some_state());
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) {
    alarm(0);
    sem_unlink(name.c_str());
  }
  EXPECT_THAT(differences(read_state(MPI_COMM_WORLD, file), some_state()), IsEmpty());
  if (rank() > 0) return;
  EXPECT_THAT(parts_of(file), IsEmpty());
}

/// One bit anywhere in what a value says, or an end that is missing: every rank hears of it.
TEST(StateFile, OneThatIsNotWholeIsRefused)
{
  const auto file = fresh_file("harmed");
  write_state(MPI_COMM_WORLD, file, some_state());
  std::string bytes;
  {
    std::ifstream in(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const auto put = [&](const std::string& contents) {
    if (rank() == 0) std::ofstream(file, std::ios::binary) << contents;
    MPI_Barrier(MPI_COMM_WORLD);
  };
  // Where the rows of a value stand: the first rank's `id`s, of which each is known.
  const std::int64_t known = 5 * std::int64_t(1'000'000'007);
  const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(&known), 8));
  ASSERT_NE(place, std::string::npos);
  for (const int bit : {0, 3, 7}) {
    std::string harmed = bytes;
    harmed[place] = char(harmed[place] ^ (1 << bit));
    put(harmed);
    EXPECT_THAT(refusal(file), HasSubstr("is no whole checkpoint (body0/id has been changed"));
    MPI_Barrier(MPI_COMM_WORLD);
  }
  for (const double share : {0.0, 0.02, 0.5, 0.99}) {
    put(bytes.substr(0, std::size_t(share * double(bytes.size()))));
    EXPECT_THAT(refusal(file), HasSubstr(file.string()));
    MPI_Barrier(MPI_COMM_WORLD);
  }
  put(bytes);
  EXPECT_EQ(refusal(file), "");
}

TEST(StateFile, OneThatIsNotThereIsRefused)
{
  EXPECT_THAT(refusal(fresh_file("absent")), HasSubstr("absent"));
}

}  // namespace
}  // namespace mpm::output
