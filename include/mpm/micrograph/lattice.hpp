#pragma once
/// The lattice of particle locations: how fine it is, and what fills it.

#include <mpm/micrograph/image.hpp>
#include <mpm/micrograph/specimen.hpp>

namespace mpm::micrograph {

/// Cells over a specimen of this size (m): as given, or the whole numbers nearest to the spacing
/// asked for; with neither, 150 along x and nearly square cells. Throws InputError.
std::array<int, 2> cell_counts(const scene::Grid& grid, const std::array<double, 2>& size);

/// Every location empty. Throws InputError for more locations than can be numbered.
Lattice empty_lattice(const std::array<int, 2>& cells, int particles_per_cell);

/// A location belongs to the last shape that contains its centre.
void fill_with_shapes(Lattice& lattice, const scene::Scene& scene);

/// A location belongs to the cell wall, or to a material, by the mean gray of the image over its
/// rectangle. Returns the threshold in use; 0 with bands, which take its place.
double fill_with_image(Lattice& lattice, const scene::Scene& scene, const GrayImage& image);

/// Filled locations / locations and kg/m^3, of the whole and of each window. A location counts
/// where its centre lies.
std::vector<RelativeDensity> densities(const Lattice& lattice, const scene::Scene& scene);

}  // namespace mpm::micrograph
