#include <mpm/core/error.hpp>
#include <mpm/micrograph/picture_file.hpp>

#include <fstream>
#include <system_error>
#include <vector>

// Static: another part of the program may hold its own copy of this single-file library.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace mpm::micrograph {

void write_bytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& file)
{
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  out.close();
  if (out) return;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
  throw FileError(file.string() +
                  ": the picture cannot be written. Check that the folder exists, is writable and "
                  "has space left.");
}

/// Into memory first: the library writes files without looking whether that worked.
void write_png(int width, int height, std::span<const std::uint8_t> gray,
               const std::filesystem::path& file)
{
  std::vector<std::uint8_t> bytes;
  const auto take = [](void* to, void* data, int size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    auto& list = *static_cast<std::vector<std::uint8_t>*>(to);
    list.insert(list.end(), first, first + size);
  };
  if (!stbi_write_png_to_func(take, &bytes, width, height, 1, gray.data(), width))
    throw FileError(file.string() + ": the picture does not fit into memory. Use a smaller one.");
  write_bytes(bytes, file);
}

}  // namespace mpm::micrograph
