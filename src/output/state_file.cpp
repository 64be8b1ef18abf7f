#include <mpm/core/error.hpp>
#include <mpm/output/hdf5_file.hpp>
#include <mpm/output/state_file.hpp>
#include <mpm/parallel/session.hpp>

#include <span>
#include <type_traits>

#include "state_contents.hpp"

namespace mpm::output {

namespace {

std::int64_t size_of(const StateValue& value)
{
  return std::visit([](const auto& values) { return std::int64_t(values.size()); }, value);
}

/// The names of a state with their kinds, and of each the length and the checksum of this rank's
/// part.
struct Contents {
  std::string names;
  std::vector<std::int64_t> parts;
  std::int64_t bytes = 0;

  explicit Contents(const MemoryArchive& state)
  {
    state.visit([&](const std::string& name, const StateValue& value) {
      names += "dit"[value.index()] + name + '\n';
      parts.insert(parts.end(), {size_of(value), checksum_of(value)});
      bytes += 8 * size_of(value);
    });
  }
};

}  // namespace

void write_state(MPI_Comm comm, const std::filesystem::path& file, const MemoryArchive& state)
{
  const Contents contents(state);
  std::int64_t bytes = contents.bytes + 16 * std::int64_t(contents.parts.size());
  sum_over_ranks(comm, std::span(&bytes, 1));
  constexpr std::int64_t headers_per_value = 4096;
  bytes +=
      headers_per_value * std::int64_t(contents.parts.size()) + std::int64_t(contents.names.size());
  Hdf5File out(comm, file, Compression::none, bytes);
  out.set_attribute("state_format", state_format);
  out.set_attribute("ranks", std::int64_t(ranks_of(comm)));
  const bool first = rank_of(comm) == 0;
  const auto as_bytes = [](const std::string& text) {
    return std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  };
  out.write_rows("/names", "1", 1, first ? as_bytes(contents.names) : as_bytes({}));
  out.write_rows("/parts", "1", int(contents.parts.size()),
                 std::span<const std::int64_t>(contents.parts));
  state.visit([&](const std::string& name, const StateValue& value) {
    std::visit(
        [&]<class T>(const T& values) {
          if constexpr (std::is_same_v<T, std::string>)
            out.write_rows(dataset_of(name), "1", 1, as_bytes(values));
          else
            out.write_rows(dataset_of(name), "1", 1, std::span(values));
        },
        value);
  });
  out.finish();
}

int ranks_of_state(const std::filesystem::path& file)
{
  const Hdf5Input input(file);
  state_entries(input);
  return int(input.attribute("ranks"));
}

MemoryArchive read_state(MPI_Comm comm, const std::filesystem::path& file)
{
  MemoryArchive state;
  agree(comm, [&] {
    const Hdf5Input input(file);
    for (const auto& [name, entry] : state_entries(input))
      state.put(name, read_part(input, name, entry, rank_of(comm)));
  });
  return state;
}

}  // namespace mpm::output
