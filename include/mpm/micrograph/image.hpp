#pragma once
/// Gray pictures: reading them from files, cutting and turning them.

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace mpm::micrograph {

/// Gray levels from 0 (black) to 255 (white), top row first. Levels of 16-bit files and of colours
/// lie between the whole numbers. A stack has its slices one after the other.
struct GrayImage {
  int width = 0, height = 0;
  std::vector<double> gray;
  std::optional<std::array<double, 2>> pixel_size;  ///< m, where the file states it
  int slices = 1;

  /// Of the first slice.
  double operator()(int column, int row) const { return gray[std::size_t(row) * width + column]; }
  double& operator()(int column, int row) { return gray[std::size_t(row) * width + column]; }
};

/// Reads a BMP (uncompressed), PNG or TIFF, told apart by their first bytes. Colours become gray by
/// ITU-R BT.601 luma. The pages of a TIFF are slices of a stack, and so are all files that fit a
/// name with a `*` in it, in the order of the numbers in their names. Throws InputError naming the
/// file, what is wrong and what to do.
GrayImage read_image(const std::filesystem::path& file);

/// The file, or those of all slices, in their order. Throws InputError where there are none.
std::vector<std::filesystem::path> files_of_image(const std::filesystem::path& file);

/// `change` done to each slice.
GrayImage each_slice(GrayImage image, const std::function<GrayImage(const GrayImage&)>& change);

// Of one slice:

/// The part {x, y from the top, width, height} of an image, in pixels.
GrayImage cropped(const GrayImage& image, const std::array<int, 4>& part);
/// Turned counter-clockwise by 0, 90, 180 or 270 degrees; the pixel size turns with it.
GrayImage turned(const GrayImage& image, int degrees);
/// Left and right exchanged.
GrayImage mirrored(const GrayImage& image);
/// Top and bottom exchanged.
GrayImage upended(const GrayImage& image);

}  // namespace mpm::micrograph
