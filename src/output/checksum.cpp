#include <mpm/core/error.hpp>
#include <mpm/output/checksum.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <zlib.h>

namespace mpm::output {

namespace {

uLong add(uLong sum, std::span<const std::byte> bytes)
{
  while (!bytes.empty()) {
    const auto part = std::min<std::size_t>(bytes.size(), std::numeric_limits<int>::max());
    sum = crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), uInt(part));
    bytes = bytes.subspan(part);
  }
  return sum;
}

}  // namespace

std::int64_t checksum_of(std::span<const std::byte> bytes)
{
  return std::int64_t(add(crc32(0, nullptr, 0), bytes));
}

std::int64_t checksum_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  uLong sum = crc32(0, nullptr, 0);
  std::array<char, 1 << 16> piece;
  while (in) {
    in.read(piece.data(), piece.size());
    sum = add(sum, std::as_bytes(std::span(piece.data(), std::size_t(in.gcount()))));
  }
  if (!in.eof()) throw FileError(fmt::format("{}: cannot be read.", file.string()));
  return std::int64_t(sum);
}

}  // namespace mpm::output
