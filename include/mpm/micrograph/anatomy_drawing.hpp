#pragma once
/// Tissue -> gray picture as a microscope would show it, with walls as thick as the density asks.

#include <mpm/micrograph/anatomy_cells.hpp>
#include <mpm/micrograph/anatomy_parameters.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mpm::micrograph::anatomy {

struct Drawing {
  int width = 0, height = 0;
  std::vector<std::uint8_t> gray;  ///< top row first
  std::vector<double> wall_scale;  ///< found for each density window
  std::vector<double> density;     ///< reached in each density window
  std::vector<Point> lumens;       ///< pixel deepest inside each lumen that lies in the picture

  std::uint8_t operator()(int i, int j) const { return gray[std::size_t(j) * width + i]; }
};

/// Throws InputError where a window's density is out of reach of its walls.
Drawing draw(const Parameters& wood, std::uint64_t seed);

/// Gray levels of `slices` equal slices of a piece `depth` um thick, one after the other, each as
/// wide and high as what draw() shows: the same tissue, where lumens close at the ends of their
/// cells (Parameters::grain). Throws as draw().
std::vector<std::uint8_t> draw_slices(const Parameters& wood, std::uint64_t seed, double depth,
                                      int slices);

/// 8-bit gray, uncompressed, bottom row first, with the pixel size in the header.
std::vector<std::uint8_t> bmp_bytes(const Drawing& drawing, const Picture& picture);

/// Throws FileError.
void write_bmp(const Drawing& drawing, const Picture& picture, const std::filesystem::path& file);
void write_png(const Drawing& drawing, const std::filesystem::path& file);

}  // namespace mpm::micrograph::anatomy
