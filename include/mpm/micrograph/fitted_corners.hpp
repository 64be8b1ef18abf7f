#pragma once
/// Corners of locations moved to where the wall ends in the picture or in the shapes.

#include <mpm/core/corner_offsets.hpp>
#include <mpm/core/index_box.hpp>
#include <mpm/micrograph/wall_places.hpp>

#include <array>
#include <functional>

namespace mpm::micrograph {

/// What is known of the lattice whose corners are to be fitted.
struct FittedLattice {
  IndexVec<2> count;             ///< locations of the whole specimen
  Vec<2> location_size;          ///< m
  std::array<bool, 2> periodic;  ///< x and y
  /// What fills a location of the specimen, or -1.
  std::function<int(const IndexVec<2>&)> body;
  /// Whether a corner stays, whatever is around it.
  std::function<bool(const IndexVec<2>&)> stays;
};

/// How far around a corner the lattice decides on its offset, locations.
inline constexpr LocalIndex fitting_reach = 34;

/// Offsets of the corners of a box of locations. Corners with void on one side move to the surface
/// of the wall, as far as the cells around them bear it; those within a body follow them a little.
/// Corners at the specimen's border move along it, as if there were a mirror or the next period;
/// those at which bodies meet, or locations by a corner alone, stay. Each corner depends on nothing
/// but what lies within `fitting_reach`: every box finds the same bits, for images of it too. The
/// ways lead corners that stand beyond the surface back towards it, as far as contact bears it.
CornerOffsets<2> fitted_corners(const IndexBox<2>& locations, const FittedLattice& lattice,
                                const WallPlaces<2>& wall);

}  // namespace mpm::micrograph
