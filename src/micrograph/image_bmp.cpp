/// Device-independent bitmaps ("BMP") as Windows 3 and later write them, uncompressed: 1, 4 or 8
/// bits with a colour table, 24 or 32 bits as blue, green, red (and an unused byte).

#include <mpm/micrograph/image_formats.hpp>

#include <cstdlib>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

constexpr std::size_t file_header = 14, core_header = 40;  // bytes
constexpr std::uint32_t uncompressed = 0;

std::uint32_t little_endian(std::span<const std::uint8_t> bytes, std::size_t at, int count)
{
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value |= std::uint32_t(bytes[at + i]) << (8 * i);
  return value;
}

struct Header {
  std::size_t pixels_at;  // offset of the first stored row
  std::size_t table_at;   // offset of the colour table
  std::int64_t width, height;
  bool top_down;
  int bits;               // per pixel
  std::size_t colours;    // in the colour table
  std::size_t row_bytes;  // rows are padded to 4 bytes
};

Header header_of(std::span<const std::uint8_t> bytes)
{
  const InputError damaged("the BMP ends before its last pixel. Copy or save the file again.");
  if (bytes.size() < file_header + core_header) throw damaged;
  const std::uint32_t header_size = little_endian(bytes, 14, 4);
  if (header_size < core_header)
    throw InputError("is an OS/2 bitmap. Save it as a Windows BMP, PNG or TIFF.");
  const std::uint32_t compression = little_endian(bytes, 30, 4);
  if (compression != uncompressed)
    throw InputError(fmt::format(
        "is a compressed BMP (compression {}). Save it uncompressed, or as PNG.", compression));

  Header header{};
  header.pixels_at = little_endian(bytes, 10, 4);
  header.table_at = file_header + header_size;
  header.width = std::int32_t(little_endian(bytes, 18, 4));
  const std::int64_t signed_height = std::int32_t(little_endian(bytes, 22, 4));
  header.height = std::abs(signed_height);
  header.top_down = signed_height < 0;
  check_dimensions(header.width, header.height);

  header.bits = int(little_endian(bytes, 28, 2));
  if (header.bits != 1 && header.bits != 4 && header.bits != 8 && header.bits != 24 &&
      header.bits != 32)
    throw InputError(fmt::format(
        "is a BMP of {} bits per pixel. Save it with 8 (gray) or 24 (colour).", header.bits));
  if (header.bits <= 8) {
    header.colours = little_endian(bytes, 46, 4);
    if (header.colours == 0) header.colours = std::size_t(1) << header.bits;
    if (header.table_at + 4 * header.colours > bytes.size()) throw damaged;
  }
  if (header.pixels_at < header.table_at + 4 * header.colours)
    throw InputError(fmt::format(
        "is a damaged BMP (its pixels begin at byte {}, inside its header). Save it again.",
        header.pixels_at));
  header.row_bytes = std::size_t((header.width * header.bits + 31) / 32 * 4);
  if (header.pixels_at + header.row_bytes * std::size_t(header.height) > bytes.size())
    throw damaged;
  return header;
}

double luma_at(std::span<const std::uint8_t> bytes, std::size_t at)
{
  return luma(bytes[at + 2], bytes[at + 1], bytes[at]);
}

}  // namespace

GrayImage read_bmp(std::span<const std::uint8_t> bytes)
{
  const Header header = header_of(bytes);
  std::vector<double> level_of_colour;
  for (std::size_t colour = 0; colour < header.colours; ++colour)
    level_of_colour.push_back(luma_at(bytes, header.table_at + 4 * colour));

  GrayImage image{int(header.width), int(header.height), {}, {}};
  image.gray.resize(std::size_t(image.width) * image.height);
  for (int row = 0; row < image.height; ++row) {
    const int stored_row = header.top_down ? row : image.height - 1 - row;
    const std::size_t row_at = header.pixels_at + header.row_bytes * std::size_t(stored_row);
    for (int column = 0; column < image.width; ++column) {
      const std::size_t bit = std::size_t(column) * std::size_t(header.bits);
      if (header.bits >= 24) {
        image(column, row) = luma_at(bytes, row_at + bit / 8);
        continue;
      }
      // Several pixels share a byte, the leftmost in the highest bits.
      const int shift = 8 - header.bits - int(bit % 8);
      const std::size_t colour = (bytes[row_at + bit / 8] >> shift) & ((1 << header.bits) - 1);
      if (colour >= level_of_colour.size())
        throw InputError(fmt::format(
            "pixel ({}, {}) has colour {}, but the BMP's table ends at {}. Save the image again.",
            column, row, colour, level_of_colour.size() - 1));
      image(column, row) = level_of_colour[colour];
    }
  }
  return image;
}

}  // namespace mpm::micrograph
