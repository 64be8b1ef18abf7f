#pragma once
/// One reader per file format. Errors say what is wrong and what to do, without the file's name:
/// read_image puts it in front.

#include <mpm/core/error.hpp>
#include <mpm/micrograph/image.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace mpm::micrograph {

/// More pixels than this are refused: 2 GiB as GrayImage.
constexpr std::int64_t most_pixels = std::int64_t(1) << 28;
/// Throws InputError unless 0 < width * height * slices <= most_pixels.
void check_dimensions(std::int64_t width, std::int64_t height, std::int64_t slices = 1);
/// Throws InputError unless the next slice is to have the size of those before it.
void check_next_slice(const GrayImage& stack, std::int64_t width, std::int64_t height);
/// Puts a slice behind those before it. Throws InputError unless they are of one size.
void add_slice(GrayImage& stack, const GrayImage& slice);

GrayImage read_bmp(std::span<const std::uint8_t> bytes);
GrayImage read_png(std::span<const std::uint8_t> bytes);
GrayImage read_tiff(const std::filesystem::path& file);

/// ITU-R BT.601 luma. Whole numbers are divided once, so that gray (r = g = b) stays exact.
constexpr double luma(double red, double green, double blue)
{
  return (299.0 * red + 587.0 * green + 114.0 * blue) / 1000.0;
}

/// Gray image of samples in the order gray [alpha] or red green blue [alpha], top row first.
template <class Sample>
GrayImage gray_from_samples(std::span<const Sample> samples, int width, int height, int channels)
{
  constexpr double full = std::numeric_limits<Sample>::max();
  const bool has_alpha = channels % 2 == 0;
  GrayImage image{width, height, std::vector<double>(std::size_t(width) * height), {}, 1};
  const Sample* pixel = samples.data();
  for (double& gray : image.gray) {
    // What lies under a transparent pixel is not in the file: neither wall nor void.
    if (has_alpha && pixel[channels - 1] != std::numeric_limits<Sample>::max())
      throw InputError(
          "the image has transparent pixels. Flatten it onto a background, or save it without "
          "alpha.");
    const double level = channels >= 3 ? luma(pixel[0], pixel[1], pixel[2]) : double(pixel[0]);
    gray = level * 255.0 / full;
    pixel += channels;
  }
  return image;
}

}  // namespace mpm::micrograph
