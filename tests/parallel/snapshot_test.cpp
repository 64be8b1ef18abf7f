#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>
#include <mpm/output/snapshot.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <hdf5.h>
#include <mpi.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace mpm::output {
namespace {

using ::testing::HasSubstr;

int rank()
{
  int number = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &number);
  return number;
}

int ranks()
{
  int number = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &number);
  return number;
}

/// A new directory for this number of ranks: runs on 1, 2 and 3 ranks may go on at the same time.
std::filesystem::path fresh_directory(const std::string& name)
{
  const auto directory =
      std::filesystem::path(MPM_SCRATCH_DIRECTORY) / (name + "_" + std::to_string(ranks()));
  if (rank() == 0) {
    std::filesystem::remove_all(directory);
    std::filesystem::create_directories(directory);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return directory;
}

/// Rank 1, if there is one, holds no particle. Every value follows from the particle's number.
Snapshot numbered(int per_rank, double time)
{
  Snapshot snapshot;
  snapshot.time = time;
  snapshot.strain = 1e3 * time;
  snapshot.step = std::int64_t(1e6 * time);
  std::vector<double> work;
  std::vector<double> velocity;
  std::vector<double> stress;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> body;
  const int before = per_rank * (rank() > 1 ? rank() - 1 : rank());
  for (int i = before; i < before + (rank() == 1 ? 0 : per_rank); ++i) {
    snapshot.position.insert(snapshot.position.end(), {0.5 * i, 100.0 + i, 0});
    work.push_back(i + time);
    velocity.insert(velocity.end(), {-10.0 - i, 0.25 * i, 0});
    for (int c = 0; c < 6; ++c) stress.push_back(10.0 * i + c);
    id.push_back((std::int64_t{1} << 40) + i);
    body.push_back(i % 3);
  }
  snapshot.fields = {{"plastic_work", "J/m3", 1, work},
                     {"velocity", "m/s", 3, velocity},
                     {"cauchy_stress", "Pa", 6, stress},
                     {"id", "1", 1, id},
                     {"body", "1", 1, body}};
  return snapshot;
}

int particles_of(int per_rank)
{
  return per_rank * (ranks() > 1 ? ranks() - 1 : 1);
}

/// Serial reading back, on rank 0.
class ReadFile {
 public:
  explicit ReadFile(const std::filesystem::path& file)
      : id_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT))
  {
    if (id_ < 0) throw FileError(file.string() + ": cannot be opened");
  }
  ~ReadFile() { H5Fclose(id_); }
  std::vector<double> numbers(const std::string& dataset) const
  {
    const hid_t set = H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    std::vector<double> values(std::size_t(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
    return values;
  }
  double attribute(const std::string& name) const
  {
    double value = -1;
    const hid_t attribute = H5Aopen(id_, name.c_str(), H5P_DEFAULT);
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    return value;
  }
  std::string unit(const std::string& dataset) const
  {
    const hid_t attribute = H5Aopen_by_name(id_, dataset.c_str(), "unit", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '\0');
    H5Aread(attribute, type, text.data());
    H5Tclose(type);
    H5Aclose(attribute);
    return text;
  }

 private:
  hid_t id_;
};

std::string text_of(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// What write() or the constructor threw, the same on every rank or the test has failed.
template <class Action>
std::string message_on_every_rank(Action&& action)
{
  std::string message = "nothing was thrown";
  try {
    action();
  } catch (const FileError& error) {
    message = error.what();
  }
  const unsigned long mine = std::hash<std::string>()(message);
  unsigned long least = 0;
  unsigned long greatest = 0;
  MPI_Allreduce(&mine, &least, 1, MPI_UNSIGNED_LONG, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &greatest, 1, MPI_UNSIGNED_LONG, MPI_MAX, MPI_COMM_WORLD);
  EXPECT_EQ(least, greatest) << message;
  return message;
}

void expect_numbered(const std::filesystem::path& file, int particles, double time)
{
  const ReadFile written(file);
  const std::vector<double> connectivity = written.numbers("/particles/connectivity");
  const std::vector<double> position = written.numbers("/particles/position");
  const std::vector<double> work = written.numbers("/particles/plastic_work");
  const std::vector<double> stress = written.numbers("/particles/cauchy_stress");
  const std::vector<double> id = written.numbers("/particles/id");
  ASSERT_EQ(connectivity.size(), std::size_t(particles));
  ASSERT_EQ(position.size(), std::size_t(3 * particles));
  ASSERT_EQ(stress.size(), std::size_t(6 * particles));
  for (int i = 0; i < particles; ++i) {
    ASSERT_EQ(connectivity[i], i);
    ASSERT_EQ(position[3 * i], 0.5 * i);
    ASSERT_EQ(position[3 * i + 1], 100.0 + i);
    ASSERT_EQ(work[i], i + time);
    ASSERT_EQ(stress[6 * i + 5], 10.0 * i + 5);
    ASSERT_EQ(id[i], double((std::int64_t{1} << 40) + i));
  }
}

TEST(SnapshotSeries, RanksStandOneAfterTheOtherWithAllFieldsAndAnEmptyRankAddsNothing)
{
  const auto directory = fresh_directory("order");
  SnapshotSeries series(MPI_COMM_WORLD, directory, "particles", {});
  series.write(numbered(100, 2e-6));
  EXPECT_EQ(series.written(), 1);
  if (rank() != 0) return;
  const auto file = directory / "snapshots" / "000000.h5";
  expect_numbered(file, particles_of(100), 2e-6);
  const ReadFile written(file);
  EXPECT_EQ(written.attribute("time"), 2e-6);
  EXPECT_EQ(written.attribute("strain"), 1e3 * 2e-6);
  EXPECT_EQ(written.attribute("step"), 2);
  EXPECT_EQ(written.attribute("complete"), 1);
  EXPECT_EQ(written.unit("/particles/position"), "m");
  EXPECT_EQ(written.unit("/particles/cauchy_stress"), "Pa");
}

TEST(SnapshotSeries, CompressedFileHoldsTheSameInLessSpace)
{
  const auto directory = fresh_directory("compressed");
  SnapshotSeries plain(MPI_COMM_WORLD, directory / "plain", "particles", {});
  SnapshotSeries packed(MPI_COMM_WORLD, directory / "packed", "particles", {.compress = true});
  plain.write(numbered(3000, 1e-6));
  packed.write(numbered(3000, 1e-6));
  packed.write(numbered(0, 2e-6));  // chunks of no particles must not trip it
  if (rank() != 0) return;
  const std::string name = "snapshots/000000.h5";
  expect_numbered(directory / "packed" / name, particles_of(3000), 1e-6);
  EXPECT_LT(std::filesystem::file_size(directory / "packed" / name),
            std::filesystem::file_size(directory / "plain" / name) / 2);
}

TEST(SnapshotSeries, SnapshotWithoutParticlesIsWritten)
{
  const auto directory = fresh_directory("nothing");
  SnapshotSeries series(MPI_COMM_WORLD, directory, "particles", {});
  series.write(numbered(0, 0));
  if (rank() == 0) expect_numbered(directory / "snapshots" / "000000.h5", 0, 0);
}

TEST(SnapshotSeries, XdmfNamesFinishedSnapshotsOnlyByRelativePath)
{
  const auto directory = fresh_directory("xdmf");
  SnapshotSeries first(MPI_COMM_WORLD, directory, "particles", {});
  first.write(numbered(10, 0));
  first.write(numbered(10, 1e-6));
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) {
    const std::string text = text_of(directory / "particles.xdmf");
    EXPECT_THAT(text, HasSubstr(">snapshots/000001.h5:/particles/cauchy_stress<"));
    EXPECT_THAT(text, HasSubstr("<Time Value=\"1e-06\""));
    EXPECT_FALSE(std::filesystem::exists(directory / "particles.xdmf.part"));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  // A second run into the same directory must not leave the first one's list in place.
  SnapshotSeries second(MPI_COMM_WORLD, directory, "particles", {});
  EXPECT_TRUE(std::filesystem::exists(directory / "particles.xdmf"));
  MPI_Barrier(MPI_COMM_WORLD);
  second.begin();
  EXPECT_FALSE(std::filesystem::exists(directory / "particles.xdmf"));
}

TEST(SnapshotSeries, DirectoryThatCannotBeMadeIsAnErrorOnEveryRank)
{
  const auto directory = fresh_directory("blocked");
  if (rank() == 0) std::ofstream(directory / "file") << "in the way";
  MPI_Barrier(MPI_COMM_WORLD);
  SnapshotSeries series(MPI_COMM_WORLD, directory / "file", "particles", {});
  const std::string message = message_on_every_rank([&] { series.write(numbered(10, 0)); });
  EXPECT_THAT(message, HasSubstr("cannot create the directory (Not a directory)"));
}

TEST(SnapshotSeries, FileThatCannotBeOpenedIsAnErrorOnEveryRankAndTheNextWriteMayWork)
{
  const auto directory = fresh_directory("in_the_way");
  SnapshotSeries series(MPI_COMM_WORLD, directory, "particles", {});
  const auto in_the_way = directory / "snapshots" / "000000.h5.part";
  if (rank() == 0) std::filesystem::create_directories(in_the_way / "folder");
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string message = message_on_every_rank([&] { series.write(numbered(10, 0)); });
  EXPECT_THAT(message, HasSubstr("000000.h5.part: cannot open the file (Is a directory)"));
  if (rank() == 0) std::filesystem::remove_all(in_the_way);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(message_on_every_rank([&] { series.write(numbered(10, 0)); }), "nothing was thrown");
}

/// So that the ranks go on with the same state, whoever sees which files are there.
TEST(SnapshotSeries, ThatGoesOnNamesWhatIsStillThereAndKeepsAllInItsState)
{
  const auto directory = fresh_directory("taken_away");
  SnapshotSeries first(MPI_COMM_WORLD, directory, "particles", {});
  for (const double time : {1e-6, 2e-6, 3e-6}) first.write(numbered(10, time));
  MemoryArchive before, after;
  before.start_saving();
  first.archive(before);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) std::filesystem::remove(directory / "snapshots" / "000001.h5");
  const std::string list = text_of(directory / "particles.xdmf");
  MPI_Barrier(MPI_COMM_WORLD);

  SnapshotSeries second(MPI_COMM_WORLD, directory, "particles", {});
  before.start_loading();
  second.archive(before);
  after.start_saving();
  second.archive(after);
  EXPECT_TRUE(differences(before, after).empty());
  EXPECT_EQ(text_of(directory / "particles.xdmf"), list);
  MPI_Barrier(MPI_COMM_WORLD);
  second.begin();
  second.write(numbered(10, 4e-6));
  const std::string names = text_of(directory / "particles.xdmf");
  for (const int k : {0, 1, 2, 3})
    EXPECT_EQ(names.find("00000" + std::to_string(k) + ".h5") != std::string::npos, k != 1) << k;
}

TEST(SnapshotSeries, FullDiskIsAnErrorOnEveryRankAndHarmsNothingWrittenBefore)
{
  const auto directory = fresh_directory("full");
  SnapshotSeries series(MPI_COMM_WORLD, directory, "particles", {});
  series.write(numbered(2000, 1e-6));
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string list = text_of(directory / "particles.xdmf");

  std::signal(SIGXFSZ, SIG_IGN);  // a file may not grow past 20 kB: writes fail as on a full disk
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit small = old;
  small.rlim_cur = 20000;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_on_every_rank([&] { series.write(numbered(2000, 2e-6)); });
  setrlimit(RLIMIT_FSIZE, &old);

  EXPECT_THAT(message,
              HasSubstr("000001.h5.part: cannot reserve room for the file (File too large)"));
  EXPECT_EQ(series.written(), 1);
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank() == 0) {
    expect_numbered(directory / "snapshots" / "000000.h5", particles_of(2000), 1e-6);
    EXPECT_EQ(text_of(directory / "particles.xdmf"), list);
    EXPECT_FALSE(std::filesystem::exists(directory / "snapshots" / "000001.h5"));
    EXPECT_FALSE(std::filesystem::exists(directory / "snapshots" / "000001.h5.part"));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  series.write(numbered(2000, 2e-6));
  if (rank() == 0) expect_numbered(directory / "snapshots" / "000001.h5", particles_of(2000), 2e-6);
}

/// A series whose number of particles changes, and what a reader must see in it: the snapshot
/// without particles is not listed.
TEST(SnapshotSeries, ForParaViewOtherCountsOtherTimesAndNoneAtAll)
{
  const char* given = std::getenv("MPM_SERIES_DIRECTORY");
  const std::filesystem::path directory = given ? given : fresh_directory("series");
  SnapshotSeries series(MPI_COMM_WORLD, directory, "particles", {});
  nlohmann::json expected = nlohmann::json::array();
  for (const auto& [per_rank, time] : {std::pair(40, 0.0), {35, 1e-6}, {0, 2.5e-6}, {30, 9e-6}}) {
    series.write(numbered(per_rank, time));
    if (per_rank == 0) continue;
    const int n = particles_of(per_rank);
    const double id = double(std::int64_t{1} << 40);
    const auto array = [](int components, double low, double high) {
      return nlohmann::json{{"components", components}, {"first_component", {low, high}}};
    };
    expected.push_back({{"time", time},
                        {"points", n},
                        {"cells", n},
                        {"bounds", {0, 0.5 * (n - 1), 100, 100 + n - 1, 0, 0}},
                        {"arrays",
                         {{"plastic_work", array(1, time, n - 1 + time)},
                          {"velocity", array(3, -10.0 - (n - 1), -10)},
                          {"cauchy_stress", array(6, 0, 10.0 * (n - 1))},
                          {"id", array(1, id, id + n - 1)},
                          {"body", array(1, 0, 2)}}}});
  }
  EXPECT_EQ(series.written(), 4);
  if (rank() == 0) std::ofstream(directory / "expected.json") << expected.dump(1) << '\n';
}

}  // namespace
}  // namespace mpm::output
