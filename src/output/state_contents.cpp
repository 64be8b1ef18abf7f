#include "state_contents.hpp"

#include <mpm/core/error.hpp>
#include <mpm/output/checksum.hpp>

#include <algorithm>
#include <numeric>
#include <span>

#include <fmt/format.h>

namespace mpm::output {

namespace {

[[noreturn]] void not_whole(const Hdf5Input& input, const std::string& why)
{
  throw FileError(fmt::format("{}: is no whole checkpoint ({}).", input.file().string(), why));
}

}  // namespace

std::int64_t checksum_of(const StateValue& value)
{
  return std::visit(
      [](const auto& values) { return checksum_of(std::as_bytes(std::span(values))); }, value);
}

std::int64_t StateEntry::before(int rank) const
{
  return std::accumulate(lengths.begin(), lengths.begin() + rank, std::int64_t(0));
}

std::map<std::string, StateEntry> state_entries(const Hdf5Input& input)
{
  if (!input.has_attribute("state_format")) not_whole(input, "something else wrote it");
  if (const std::int64_t found = input.attribute("state_format"); found != state_format)
    not_whole(input, fmt::format("its format is {}, not {}", found, state_format));
  if (!input.has_attribute("complete")) not_whole(input, "writing it did not come to an end");
  const std::int64_t ranks = input.attribute("ranks");
  if (ranks < 1 || input.rows("/parts") != ranks) not_whole(input, "parts are missing");
  const auto names = input.read_rows<std::uint8_t>("/names", 0, input.rows("/names"));
  const auto parts = input.read_rows<std::int64_t>("/parts", 0, ranks);
  const std::size_t width = parts.size() / std::size_t(ranks);
  std::map<std::string, StateEntry> entries;
  std::size_t column = 0;
  for (auto at = names.begin(); at != names.end();) {
    const auto end = std::find(at, names.end(), '\n');
    if (end == names.end() || at == end || column + 2 > width)
      not_whole(input, "its list ends early");
    StateEntry& entry = entries[std::string(at + 1, end)];
    entry.letter = char(*at);
    for (std::size_t rank = 0; rank < std::size_t(ranks); ++rank) {
      entry.lengths.push_back(parts[rank * width + column]);
      entry.checksums.push_back(parts[rank * width + column + 1]);
    }
    at = end + 1;
    column += 2;
  }
  if (column != width) not_whole(input, "its list ends early");
  return entries;
}

StateValue read_part(const Hdf5Input& input, const std::string& name, const StateEntry& entry,
                     int rank)
{
  const std::string dataset = dataset_of(name);
  const std::int64_t first = entry.before(rank), count = entry.lengths[std::size_t(rank)];
  StateValue value;
  if (entry.letter == 'd') {
    value = input.read_rows<double>(dataset, first, count);
  } else if (entry.letter == 'i') {
    value = input.read_rows<std::int64_t>(dataset, first, count);
  } else {
    const std::vector<std::uint8_t> bytes = input.read_rows<std::uint8_t>(dataset, first, count);
    value = std::string(bytes.begin(), bytes.end());
  }
  if (checksum_of(value) != entry.checksums[std::size_t(rank)])
    not_whole(input, fmt::format("{} has been changed on rank {}", name, rank));
  return value;
}

}  // namespace mpm::output
