#pragma once
/// Small image files written byte by byte, in a directory that vanishes with the test.

#include <mpm/core/error.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mpm::micrograph::test {

using Bytes = std::vector<std::uint8_t>;
/// Rows of gray levels, the top row first: as a picture reads.
using Rows = std::vector<std::vector<int>>;

class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path write(const std::string& name, const Bytes& bytes) const;

 private:
  std::filesystem::path path_;
};

/// A bitmap whose `pixels` are its rows as stored: padded to 4 bytes, bottom row first unless the
/// height is negative.
Bytes bmp(int width, int height, int bits,
          const std::vector<std::array<std::uint8_t, 3>>& rgb_table, const Bytes& pixels,
          std::uint32_t compression = 0);
/// 8-bit gray bitmap, bottom row first.
Bytes gray_bmp(const Rows& rows);

/// A PNG whose samples are `pixels`, top row first; colour types: 0 gray, 2 RGB, 4 gray and alpha,
/// 6 RGB and alpha.
Bytes png(int width, int height, int bits, int colour_type, const Bytes& pixels);

/// Message of the InputError that `action` throws; "" if it throws none.
template <class Action>
std::string message_of(Action action)
{
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace mpm::micrograph::test
