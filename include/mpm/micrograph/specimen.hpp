#pragma once
/// From a scene's specimen (an image or shapes) to a lattice of particle locations.

#include <mpm/scene/scene.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mpm::micrograph {

/// Regular lattice of particle locations over the specimen. x runs fastest; row 0 is at the bottom
/// (images are stored top row first: the mapping turns them over).
struct Lattice {
  static constexpr std::int8_t empty = -1;
  int nx = 0, ny = 0;                 ///< locations = cells x particles_per_cell
  std::vector<std::int8_t> material;  ///< index into scene.materials, or `empty`; nx * ny
  std::vector<std::int16_t>
      shape;  ///< index into specimen.shapes (initial velocity); empty for images

  std::int8_t operator()(int i, int j) const { return material[std::size_t(j) * nx + i]; }
};

struct RelativeDensity {
  std::string window;   ///< "" for the whole specimen
  double value;         ///< filled locations / locations
  double bulk_density;  ///< kg/m^3
};

struct SpecimenModel {
  std::array<double, 2> size;  ///< m
  std::array<int, 2> cells;
  int particles_per_cell;  ///< per direction
  Lattice lattice;
  std::vector<RelativeDensity> densities;  ///< whole specimen first, then the windows
  double threshold = 0;                    ///< gray level in use (image only)
  long removed = 0;                        ///< locations removed as specks or unconnected pieces

  std::int64_t locations() const { return std::int64_t(lattice.nx) * lattice.ny; }
  std::int64_t particles() const;  ///< filled locations
};

/// Reads the image named by the scene, or rasters its shapes.
/// Throws InputError (missing, unreadable or unsuitable image; no wall found; size unknown).
SpecimenModel build_specimen(const scene::Scene& scene);

}  // namespace mpm::micrograph
