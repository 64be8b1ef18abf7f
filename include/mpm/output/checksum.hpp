#pragma once
/// CRC-32: tells harm from wholeness, not malice.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace mpm::output {

std::int64_t checksum_of(std::span<const std::byte> bytes);
/// Throws FileError if it cannot be read.
std::int64_t checksum_of(const std::filesystem::path& file);

}  // namespace mpm::output
