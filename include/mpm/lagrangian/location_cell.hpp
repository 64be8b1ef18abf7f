#pragma once
/// A cell as large as a particle's location, integrated at its centre, with modes of bending: what
/// a wall of one cell bends with. `CellDeformation`, `corner_forces` and the modes are of the plane
/// (plane_cell.hpp) or of space (brick.hpp, brick_bending.hpp).

#include <mpm/materials/law.hpp>

namespace mpm {

/// Places of corners, m, or forces on them, N. Bit d of the corner: upper along axis d.
template <int Dim>
struct CellCorners {
  static constexpr int count = 1 << Dim;
  Lanes along[Dim][count];
};

/// Of cells of one size at rest, m.
template <int Dim>
struct CellFrame;

/// How a block of cells is stretched and bent, from the places of its corners.
template <int Dim>
struct CellDeformation;

/// What bends a cell: from its modes to moments, and what a law takes of them.
template <int Dim>
class CellBending;

/// A cell's corner whose edges span less than this of their volume at rest is held open.
inline constexpr double least_corner = 0.2;

/// One of a block's columns.
[[gnu::always_inline]] inline Lanes column(const double* block, int index)
{
  return load(block + index * lane_count);
}

}  // namespace mpm
