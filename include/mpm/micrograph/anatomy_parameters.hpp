#pragma once
/// What a parameter file says about a piece of wood to draw. Lengths in micrometres; x is radial
/// (bark to the right), y tangential, from the picture's top left corner.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm::micrograph::anatomy {

struct Picture {
  int width_px = 360, height_px = 234;
  double width = 832, height = 541;
};

struct Gray {
  double wall = 200, lumen = 48;  ///< of 0..255
  double edge = 14, lamella = 12, noise = 5, shading = 5;
  int blur = 1;
};

/// Scatter of single cells (relative) and of the tissue as a whole.
struct Irregularity {
  double position = 0.08, size = 0.1, wall = 0.1;
  double wave = 6, wave_length = 220;
  double rim = 0.7, rim_length = 14;
};

struct CellKind {
  double radial_pitch, wall, roundness;
};

struct Files {
  double tangential_pitch = 28, tangential_scatter = 0.12, stretch = 1.3;
  CellKind earlywood{36, 3.2, 0.6};
  CellKind latewood{16, 5, 0.85};
};

/// Ring boundaries lie at `boundary` + k `width`; latewood fills the end of each ring.
struct GrowthRing {
  double boundary = 1e6, width = 1e6, latewood = 0, transition = 60;
};

struct Rays {
  double spacing = 200, cell_height = 12, cell_length = 90, wall = 1.8, filled = 0;
  int rows = 1;
};

struct Vessels {
  double per_mm2 = 60, smallest = 40, largest = 70, wall = 2.5, group_chance = 0.5;
};

/// Along z, for a stack of slices.
struct Grain {
  double cell_length = 3000, taper = 40;
};

struct ResinCanal {
  double x = 0, y = 0, diameter = 100, epithelium = 16, wall = 1.6;
};

/// Part of the picture's width, as fractions, whose walls are scaled to reach a relative density.
struct DensityWindow {
  double from = 0, to = 1, relative_density = 0.5;
};

/// A location of the lattice is cell wall where the mean gray over it reaches the threshold.
struct Density {
  double threshold = 150;
  int lattice_x = 300, lattice_y = 194;
  std::vector<DensityWindow> windows;
};

struct Parameters {
  std::filesystem::path file;
  std::uint64_t seed = 1;
  Picture picture;
  Gray gray;
  Irregularity irregularity;
  Files files;
  GrowthRing growth_ring;
  std::optional<Rays> rays;
  std::optional<Vessels> vessels;
  std::optional<Grain> grain;
  std::vector<ResinCanal> resin_canals;
  std::optional<Density> density;
};

/// Throws InputError with every problem found, FileError if the file cannot be read.
Parameters read_parameters(const std::filesystem::path& file);

/// Every key with unit, range, default and meaning, as a Markdown table.
std::string key_table();

}  // namespace mpm::micrograph::anatomy
