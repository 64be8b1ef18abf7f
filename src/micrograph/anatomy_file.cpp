#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/picture_file.hpp>

#include <cmath>

namespace mpm::micrograph::anatomy {

namespace {

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, int count)
{
  for (int k = 0; k < count; ++k) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
}

}  // namespace

std::vector<std::uint8_t> bmp_bytes(const Drawing& drawing, const Picture& picture)
{
  constexpr std::uint32_t file_header = 14, picture_header = 40, levels = 256;
  constexpr std::uint32_t pixels_at = file_header + picture_header + 4 * levels;
  const std::uint32_t row = (drawing.width + 3) / 4 * 4;  // rows are padded to 4 bytes
  const auto per_metre = [](int pixels, double micrometres) {
    return static_cast<std::uint32_t>(std::floor(pixels / micrometres * 1e6 + 0.5));
  };

  std::vector<std::uint8_t> bytes{'B', 'M'};
  append(bytes, pixels_at + row * drawing.height, 4);
  append(bytes, 0, 4);
  append(bytes, pixels_at, 4);
  append(bytes, picture_header, 4);
  append(bytes, drawing.width, 4);
  append(bytes, drawing.height, 4);  // positive: bottom row first
  append(bytes, 1, 2);               // planes
  append(bytes, 8, 2);               // bits per pixel
  append(bytes, 0, 4);               // not compressed
  append(bytes, row * drawing.height, 4);
  append(bytes, per_metre(drawing.width, picture.width), 4);
  append(bytes, per_metre(drawing.height, picture.height), 4);
  append(bytes, levels, 4);
  append(bytes, 0, 4);  // every colour matters
  for (std::uint32_t level = 0; level < levels; ++level) append(bytes, level * 0x010101U, 4);
  for (int j = drawing.height - 1; j >= 0; --j) {
    const auto begin = drawing.gray.begin() + std::ptrdiff_t(j) * drawing.width;
    bytes.insert(bytes.end(), begin, begin + drawing.width);
    bytes.resize(bytes.size() + row - drawing.width, 0);
  }
  return bytes;
}

void write_bmp(const Drawing& drawing, const Picture& picture, const std::filesystem::path& file)
{
  write_bytes(bmp_bytes(drawing, picture), file);
}

void write_png(const Drawing& drawing, const std::filesystem::path& file)
{
  micrograph::write_png(drawing.width, drawing.height, drawing.gray, file);
}

}  // namespace mpm::micrograph::anatomy
