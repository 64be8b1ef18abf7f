#pragma once
/// What stands in a file of states: the list of its values, and of each the length and the checksum
/// of every rank's part.

#include <mpm/core/memory_archive.hpp>
#include <mpm/output/hdf5_input.hpp>

#include <map>
#include <string>
#include <vector>

namespace mpm::output {

inline constexpr std::int64_t state_format = 1;

using StateValue = MemoryArchive::Value;

inline std::string dataset_of(const std::string& name)
{
  return "/state/" + name;
}

/// Of what is in memory, which is what is in the file on any machine of today.
std::int64_t checksum_of(const StateValue& value);

/// Of a value: its kind, and of each rank's part the length and the checksum.
struct StateEntry {
  char letter;  ///< d, i or t: numbers, whole numbers, text
  std::vector<std::int64_t> lengths, checksums;

  std::int64_t before(int rank) const;  ///< how much of it stands before this rank's part
  std::int64_t length() const { return before(int(lengths.size())); }  ///< of all ranks
};

/// Values by name. Throws FileError if the file is not whole or not of this kind.
std::map<std::string, StateEntry> state_entries(const Hdf5Input& input);

/// A rank's part. Throws FileError if it has another checksum.
StateValue read_part(const Hdf5Input& input, const std::string& name, const StateEntry& entry,
                     int rank);

}  // namespace mpm::output
