#pragma once
/// Where the cells of a piece of wood lie.

#include <mpm/micrograph/anatomy_cells.hpp>
#include <mpm/micrograph/anatomy_parameters.hpp>

#include <vector>

namespace mpm::micrograph::anatomy {

/// Share of latewood, 0..1, at the radial place x (um).
double latewood_share(const GrowthRing& ring, double x);

/// Cells that cover the picture and a margin around it.
std::vector<Cell> grow_tissue(const Parameters& wood, std::uint64_t seed);

}  // namespace mpm::micrograph::anatomy
