#include <mpm/core/error.hpp>
#include <mpm/output/hdf5_file.hpp>
#include <mpm/output/replace_file.hpp>
#include <mpm/output/snapshot.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <system_error>

#include <fmt/core.h>

namespace mpm::output {

namespace {

/// The particles' numbers in the order of the file: what makes a cell of every point.
template <class Index>
void write_connectivity(Hdf5File& file, std::int64_t first, std::size_t count)
{
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index(first));
  file.write_rows("/particles/connectivity", "1", 1, std::span<const Index>(numbers));
}

std::string file_of(int number)
{
  return fmt::format("snapshots/{:06}.h5", number);
}

void archive_grid(Archive& archive, XdmfGrid& grid)
{
  archive.text("file", grid.file);
  archive.value("time", grid.time);
  archive.value("strain", grid.strain);
  archive.value("particles", grid.particles);
  int connectivity = int(grid.connectivity), arrays = int(grid.arrays.size());
  archive.value("connectivity", connectivity);
  grid.connectivity = NumberType(connectivity);
  archive.value("arrays", arrays);
  grid.arrays.resize(std::size_t(arrays));
  for (XdmfArray& array : grid.arrays) {
    const Archive::Section section(archive, "array" + std::to_string(&array - grid.arrays.data()));
    archive.text("name", array.name);
    archive.text("unit", array.unit);
    archive.value("components", array.components);
    int type = int(array.type);
    archive.value("type", type);
    array.type = NumberType(type);
  }
}

/// At most: integers may be shorter, compressed arrays are.
std::int64_t expected_bytes(const Snapshot& snapshot, std::int64_t particles)
{
  constexpr std::int64_t headers_per_array = 2048;
  std::int64_t values = 1 + 3;  // connectivity, position
  for (const ParticleField& field : snapshot.fields) values += field.components;
  return 8 * values * particles + headers_per_array * std::int64_t(8 + snapshot.fields.size());
}

}  // namespace

SnapshotSeries::SnapshotSeries(MPI_Comm comm, std::filesystem::path directory, std::string name,
                               Options options)
    : comm_(comm), directory_(std::move(directory)), name_(std::move(name)), options_(options)
{
}

void SnapshotSeries::begin()
{
  on_rank_zero(comm_, [this] { write_list(); });
}

/// On one rank. Files may have been moved or taken away meanwhile, of which other ranks know
/// nothing: what they share is all that has been written.
void SnapshotSeries::write_list() const
{
  std::vector<XdmfGrid> there;
  std::ranges::copy_if(entries_, std::back_inserter(there), [this](const XdmfGrid& entry) {
    return std::filesystem::exists(directory_ / entry.file);
  });
  const std::filesystem::path list = directory_ / (name_ + ".xdmf");
  std::error_code ignored;  // usually there is none
  if (there.empty())
    std::filesystem::remove(list, ignored);
  else
    write_xdmf(list, name_, there);
}

void SnapshotSeries::write(const Snapshot& snapshot)
{
  MPM_ASSERT(snapshot.position.size() % 3 == 0);
  const std::size_t mine = snapshot.position.size() / 3;
  XdmfGrid entry;
  entry.file = file_of(written_);
  entry.time = snapshot.time;
  entry.strain = snapshot.strain;
  std::int64_t before = 0;
  const std::int64_t count = std::int64_t(mine);
  MPI_Exscan(&count, &before, 1, MPI_INT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&count, &entry.particles, 1, MPI_INT64_T, MPI_SUM, comm_);
  if (entry.particles > std::numeric_limits<std::int32_t>::max())
    entry.connectivity = NumberType::int64;

  on_rank_zero(comm_, [this] { make_directory(directory_ / "snapshots"); });
  Hdf5File file(comm_, directory_ / entry.file,
                options_.compress ? Compression::gzip : Compression::none,
                expected_bytes(snapshot, entry.particles));
  file.set_attribute("time", snapshot.time);
  file.set_attribute("strain", snapshot.strain);
  file.set_attribute("step", snapshot.step);
  file.set_attribute("particle_volume", snapshot.particle_volume);
  file.create_group("/particles");
  if (entry.connectivity == NumberType::int32)
    write_connectivity<std::int32_t>(file, before, mine);
  else
    write_connectivity<std::int64_t>(file, before, mine);
  file.write_rows("/particles/position", "m", 3, std::span<const double>(snapshot.position));
  for (const ParticleField& field : snapshot.fields) {
    std::visit(
        [&](const auto& values) {
          MPM_ASSERT(values.size() == mine * std::size_t(field.components));
          file.write_rows("/particles/" + field.name, field.unit, field.components,
                          std::span(values));
        },
        field.values);
    // The alternatives of the variant stand in the order of NumberType.
    entry.arrays.push_back(
        {field.name, field.unit, field.components, NumberType(field.values.index())});
  }
  file.finish();

  ++written_;
  if (entry.particles == 0) return;  // ParaView divides by the number of rows and ends
  entries_.push_back(std::move(entry));
  on_rank_zero(comm_, [this] { write_list(); });
}

void SnapshotSeries::archive(Archive& archive)
{
  const Archive::Section section(archive, "series");
  archive.value("written", written_);
  int count = int(entries_.size());
  archive.value("count", count);
  entries_.resize(std::size_t(count));
  for (int k = 0; k < count; ++k) {
    const Archive::Section of_entry(archive, fmt::format("{:06}", k));
    archive_grid(archive, entries_[std::size_t(k)]);
  }
}

void SnapshotSeries::cut(int written)
{
  const std::string first_gone = file_of(written);
  std::erase_if(entries_, [&](const XdmfGrid& entry) { return entry.file >= first_gone; });
  on_rank_zero(comm_, [&] {
    write_list();  // before the files: it never names one that is gone
    std::error_code ignored;
    for (int k = written; k < written_; ++k)
      std::filesystem::remove(directory_ / file_of(k), ignored);
  });
  written_ = written;
}

}  // namespace mpm::output
