#pragma once
/// How much of the wall is thin beside the grid.

#include <mpm/micrograph/specimen.hpp>

#include <span>

namespace mpm::micrograph {

/// Thinner walls have no bending stiffness of their own: docs/theory.md.
inline constexpr int thin_wall_cells = 2;

struct ThinCount {
  GlobalIndex filled = 0, thin = 0;  ///< locations of what can be deformed
};

/// Local thickness after Hildebrand & Rueegsegger (1997), J. Microsc. 185:67: a filled location is
/// thin if no disc (in space: ball) of `cells` cells that is filled all over covers it. The
/// specimen is mirrored at its borders: a wall cut by one of them is not thin for that. Not
/// collective; any part may ask for any box of locations.
template <int Dim>
ThinCount count_thin(const Specimen<Dim>& specimen, std::span<const scene::Material> materials,
                     const IndexBox<Dim>& part, int cells);

/// Of the whole specimen. Collective.
template <int Dim>
ThinCount count_thin(const Specimen<Dim>& specimen, std::span<const scene::Material> materials,
                     int cells, const Share& share);

}  // namespace mpm::micrograph
