#include <mpm/micrograph/image_formats.hpp>

#include <memory>

#include <fmt/format.h>

// Static: another part of the program may hold its own copy of this single-file library.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace mpm::micrograph {

namespace {

struct Release {
  void operator()(void* samples) const { stbi_image_free(samples); }
};

template <class Sample, class Load>
GrayImage loaded(std::span<const std::uint8_t> bytes, Load load)
{
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<Sample, Release> samples(
      load(bytes.data(), int(bytes.size()), &width, &height, &channels, 0));
  if (!samples)
    throw InputError(
        fmt::format("is a damaged PNG ({}). Copy or save the file again.", stbi_failure_reason()));
  const std::span<const Sample> all(samples.get(), std::size_t(width) * height * channels);
  return gray_from_samples<Sample>(all, width, height, channels);
}

std::int64_t big_endian(std::span<const std::uint8_t> bytes, std::size_t at)
{
  std::int64_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | bytes[i];
  return value;
}

/// The loader takes memory for as many bytes as a chunk says that it has, before it looks for them.
void check_chunks(std::span<const std::uint8_t> bytes)
{
  constexpr std::size_t first = 8, ahead = 8, behind = 4;  // length and name; checksum
  for (std::size_t at = first; at + ahead <= bytes.size();) {
    const std::size_t length = std::size_t(big_endian(bytes, at));
    const std::size_t left = bytes.size() - at - ahead;
    if (length > left)
      throw InputError(
          fmt::format("is a damaged PNG (a part of it has {} bytes, and {} are left). Copy or save "
                      "the file again.",
                      length, left));
    at += ahead + length + behind;
  }
}

}  // namespace

GrayImage read_png(std::span<const std::uint8_t> bytes)
{
  if (bytes.size() > std::size_t(std::numeric_limits<int>::max()))
    throw InputError("the PNG is larger than 2 GiB. Scale it down, or save it as TIFF.");
  const int size = int(bytes.size());
  constexpr std::size_t width_at = 16, height_at = 20;  // in the header chunk, which comes first
  // A file too short to have a header is reported by the loader.
  if (bytes.size() >= height_at + 4)
    check_dimensions(big_endian(bytes, width_at), big_endian(bytes, height_at));
  check_chunks(bytes);
  if (stbi_is_16_bit_from_memory(bytes.data(), size))
    return loaded<std::uint16_t>(bytes, stbi_load_16_from_memory);
  return loaded<std::uint8_t>(bytes, stbi_load_from_memory);
}

}  // namespace mpm::micrograph
