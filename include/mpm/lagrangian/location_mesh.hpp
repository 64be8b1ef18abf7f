#pragma once
/// Cells of one rank that are locations of the lattice, and the nodes at their corners.

#include <mpm/core/index_box.hpp>
#include <mpm/lagrangian/body_pairs.hpp>
#include <mpm/parallel/shared_nodes.hpp>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mpm {

/// Cells that have an edge (in space a face) in common share its nodes, and so do those that meet
/// in a corner alone: there a wall is a hinge. Bodies that are apart have nodes of their own. Where
/// an axis is periodic, a rank that has cells at both ends of it holds the nodes between them
/// twice, as images.
template <int Dim>
struct LocationMesh {
  static constexpr int corners = 1 << Dim;

  /// Bit d of a corner: upper along axis d.
  static IndexVec<Dim> offset_of(int corner)
  {
    IndexVec<Dim> offset;
    for (int d = 0; d < Dim; ++d) offset[d] = corner >> d & 1;
    return offset;
  }

  /// Of each cell, in the order in which they were given: its nodes.
  std::vector<std::array<LocalIndex, corners>> cells;
  std::vector<IndexVec<Dim>> nodes;  ///< corners of the lattice, x fastest; of bodies apart in turn
  /// Of each node: the first body that has it, which is the same on every rank.
  std::vector<char> first_bodies;
  std::vector<char> owned;  ///< by one rank each; images by nobody
  SharedNodes shared;
};

/// Who has a location, and whose body's cell it is; -1 where it is empty or beyond.
struct Occupant {
  int rank = -1, body = -1;
};

/// Locations beyond which none decides whether a cell is near a surface.
inline constexpr LocalIndex contact_reach = 2;

/// Whether a cell has a face with no cell behind it, or touches one that has: where much presses,
/// corners come through the outer layer, and would meet nothing behind it.
template <int Dim, class IsTaken>
bool near_surface(const IndexVec<Dim>& location, const IsTaken& is_taken)
{
  bool found = false;
  const IndexVec<Dim> reach = IndexVec<Dim>::Constant(contact_reach);
  for_each_index(IndexBox<Dim>{-reach, (reach.array() + 1).matrix()},
                 [&](const IndexVec<Dim>& way) {
                   // Beyond one location only straight on from one of those.
                   if (!found && (way.cwiseAbs().array() == contact_reach).count() <= 1)
                     found = !is_taken(location + way);
                 });
  return found;
}

template <int Dim>
using OccupantOf = std::function<Occupant(const IndexVec<Dim>&)>;

/// Of one rank. `cells`: its locations; `occupant_of` a location of the lattice is asked for those
/// and the ones around them; `period`: locations after which an axis begins again, or 0. Every rank
/// that has cells at a node finds the same. Not collective.
template <int Dim>
LocationMesh<Dim> make_location_mesh(std::span<const IndexVec<Dim>> cells, int rank,
                                     const OccupantOf<Dim>& occupant_of, const BodyPairs& pairs,
                                     const IndexVec<Dim>& period);

}  // namespace mpm
