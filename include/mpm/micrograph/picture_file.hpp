#pragma once
/// Pictures in files.

#include <cstdint>
#include <filesystem>
#include <span>

namespace mpm::micrograph {

/// Throws FileError where not all of them could be written, and leaves no part of a file.
void write_bytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Gray levels [height * width], the uppermost row first, as a PNG. Throws FileError as above.
void write_png(int width, int height, std::span<const std::uint8_t> gray,
               const std::filesystem::path& file);

}  // namespace mpm::micrograph
