#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/image_formats.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file)
{
  if (std::filesystem::is_directory(file))
    throw InputError("is a directory. Name the image file in it.");
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream)
    throw InputError(
        fmt::format("cannot be opened ({}). Check the name of the image.", std::strerror(errno)));
  std::vector<std::uint8_t> bytes(std::size_t(stream.tellg()));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
    throw InputError("cannot be read to its end. Copy the file again.");
  return bytes;
}

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view magic)
{
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

GrayImage read_by_format(const std::filesystem::path& file)
{
  using namespace std::string_view_literals;
  const std::vector<std::uint8_t> bytes = bytes_of(file);
  if (bytes.empty()) throw InputError("is empty. Save the image again.");
  if (starts_with(bytes, "BM")) return read_bmp(bytes);
  if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return read_png(bytes);
  // Classic and big TIFF, in either byte order.
  if (starts_with(bytes, "II*\0"sv) || starts_with(bytes, "MM\0*"sv) ||
      starts_with(bytes, "II+\0"sv) || starts_with(bytes, "MM\0+"sv))
    return read_tiff(file);
  if (starts_with(bytes, "\xff\xd8\xff"))
    throw InputError(
        "is a JPEG, whose compression shifts gray levels at the walls. Save it as PNG or TIFF.");
  throw InputError("is not a BMP, PNG or TIFF image. Save it in one of these formats.");
}

}  // namespace

void check_dimensions(std::int64_t width, std::int64_t height)
{
  if (width <= 0 || height <= 0)
    throw InputError(
        fmt::format("the image has no pixels ({} x {}). Save it again.", width, height));
  if (width > most_pixels / height)
    throw InputError(
        fmt::format("{} x {} pixels are too many (at most {}). Cut out the part to be modelled, or "
                    "scale the image down.",
                    width, height, most_pixels));
}

GrayImage read_image(const std::filesystem::path& file)
{
  try {
    return read_by_format(file);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

GrayImage cropped(const GrayImage& image, const std::array<int, 4>& part)
{
  const auto [left, top, width, height] = part;
  if (left < 0 || top < 0 || width <= 0 || height <= 0 || width > image.width - left ||
      height > image.height - top)
    throw InputError(
        fmt::format("specimen.crop is [{}, {}, {}, {}] (x, y from the top, width, height), outside "
                    "the image of {} x {} pixels. Keep it inside.",
                    left, top, width, height, image.width, image.height));
  GrayImage result{width, height, {}, image.pixel_size};
  result.gray.reserve(std::size_t(width) * height);
  for (int row = top; row < top + height; ++row) {
    const double* first = &image.gray[std::size_t(row) * image.width + left];
    result.gray.insert(result.gray.end(), first, first + width);
  }
  return result;
}

GrayImage turned(const GrayImage& image, int degrees)
{
  switch (degrees) {
    case 0:
      return image;
    case 180:
      return upended(mirrored(image));
    case 270:
      return turned(turned(image, 180), 90);
    case 90:
      break;
    default:
      throw InputError(
          fmt::format("specimen.rotate is {} degrees. Give 0, 90, 180 or 270.", degrees));
  }
  // The right column becomes the top row.
  GrayImage result{image.height, image.width, std::vector<double>(image.gray.size()), {}};
  if (image.pixel_size) result.pixel_size = {(*image.pixel_size)[1], (*image.pixel_size)[0]};
  for (int row = 0; row < result.height; ++row)
    for (int column = 0; column < result.width; ++column)
      result(column, row) = image(image.width - 1 - row, column);
  return result;
}

GrayImage mirrored(const GrayImage& image)
{
  GrayImage result = image;
  for (int row = 0; row < image.height; ++row) {
    const auto first = result.gray.begin() + std::ptrdiff_t(row) * image.width;
    std::reverse(first, first + image.width);
  }
  return result;
}

GrayImage upended(const GrayImage& image)
{
  GrayImage result = image;
  for (int row = 0; row < image.height; ++row)
    std::copy_n(image.gray.begin() + std::ptrdiff_t(row) * image.width, image.width,
                result.gray.begin() + std::ptrdiff_t(image.height - 1 - row) * image.width);
  return result;
}

}  // namespace mpm::micrograph
