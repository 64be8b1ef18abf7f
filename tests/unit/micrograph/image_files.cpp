#include "image_files.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace mpm::micrograph::test {

TemporaryDirectory::TemporaryDirectory()
{
  std::string name = (std::filesystem::temp_directory_path() / "micrograph_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryDirectory::write(const std::string& name, const Bytes& bytes) const
{
  const std::filesystem::path file = path_ / name;
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  return file;
}

namespace {

void put_little(Bytes& bytes, std::uint32_t value, int count)
{
  for (int i = 0; i < count; ++i) bytes.push_back(std::uint8_t(value >> (8 * i)));
}

void put_big(Bytes& bytes, std::uint32_t value)
{
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(std::uint8_t(value >> shift));
}

void put_chunk(Bytes& png, const std::string& type, const Bytes& content)
{
  put_big(png, std::uint32_t(content.size()));
  const std::size_t checked_from = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), content.begin(), content.end());
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = checked_from; i < png.size(); ++i) {
    crc ^= png[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  put_big(png, ~crc);
}

/// zlib stream with one block that is stored, not compressed.
Bytes stored_zlib(const Bytes& content)
{
  Bytes stream{0x78, 0x01, 0x01};
  put_little(stream, std::uint32_t(content.size()), 2);
  put_little(stream, ~std::uint32_t(content.size()), 2);
  stream.insert(stream.end(), content.begin(), content.end());
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const std::uint8_t byte : content) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  put_big(stream, b << 16 | a);
  return stream;
}

}  // namespace

Bytes bmp(int width, int height, int bits,
          const std::vector<std::array<std::uint8_t, 3>>& rgb_table, const Bytes& pixels,
          std::uint32_t compression)
{
  const auto pixels_at = std::uint32_t(54 + 4 * rgb_table.size());
  Bytes bytes{'B', 'M'};
  put_little(bytes, std::uint32_t(pixels_at + pixels.size()), 4);
  put_little(bytes, 0, 4);
  put_little(bytes, pixels_at, 4);
  put_little(bytes, 40, 4);  // size of the header that follows
  put_little(bytes, std::uint32_t(width), 4);
  put_little(bytes, std::uint32_t(height), 4);
  put_little(bytes, 1, 2);  // planes
  put_little(bytes, std::uint32_t(bits), 2);
  put_little(bytes, compression, 4);
  put_little(bytes, std::uint32_t(pixels.size()), 4);
  put_little(bytes, 3780, 4);  // pixels per metre: the usual 96 per inch
  put_little(bytes, 3780, 4);
  put_little(bytes, std::uint32_t(rgb_table.size()), 4);
  put_little(bytes, 0, 4);  // all colours are important
  for (const auto& [red, green, blue] : rgb_table)
    bytes.insert(bytes.end(), {blue, green, red, std::uint8_t(0)});
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

Bytes gray_bmp(const Rows& rows)
{
  std::vector<std::array<std::uint8_t, 3>> grays;
  for (int level = 0; level < 256; ++level)
    grays.push_back({std::uint8_t(level), std::uint8_t(level), std::uint8_t(level)});
  Bytes pixels;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    pixels.insert(pixels.end(), row->begin(), row->end());
    while (pixels.size() % 4 != 0) pixels.push_back(0);
  }
  return bmp(int(rows.front().size()), int(rows.size()), 8, grays, pixels);
}

Bytes png(int width, int height, int bits, int colour_type, const Bytes& pixels)
{
  Bytes bytes{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  put_big(header, std::uint32_t(width));
  put_big(header, std::uint32_t(height));
  header.insert(header.end(), {std::uint8_t(bits), std::uint8_t(colour_type), 0, 0, 0});
  put_chunk(bytes, "IHDR", header);
  const std::size_t row_bytes = pixels.size() / std::size_t(height);
  Bytes filtered;
  for (std::size_t at = 0; at < pixels.size(); ++at) {
    if (at % row_bytes == 0) filtered.push_back(0);  // each row begins with its filter: none
    filtered.push_back(pixels[at]);
  }
  put_chunk(bytes, "IDAT", stored_zlib(filtered));
  put_chunk(bytes, "IEND", {});
  return bytes;
}

}  // namespace mpm::micrograph::test
