#pragma once
/// Which rank owns which cells and nodes of the background grid, for any number of ranks.

#include <mpm/grid/grid_geometry.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mpm {

/// Every rank knows the whole map. Node i and cell i (between nodes i and i + 1) belong to the same
/// rank; the last node of an axis bounds no cell.
template <int Dim>
class Ownership {
 public:
  /// First node of each part along each axis, and the end.
  using Cuts = std::array<std::vector<LocalIndex>, Dim>;

  /// A tensor product of cuts, ranks x fastest.
  Ownership(const GridGeometry<Dim>& geometry, Cuts cuts);
  /// Blocks of `edge` cells per axis, x fastest, each with the rank it belongs to. Every rank has
  /// at least one.
  Ownership(const GridGeometry<Dim>& geometry, LocalIndex edge, std::vector<int> rank_of_block,
            int ranks);

  /// From `packed` of one on the same grid. Throws InputError if it is none.
  static Ownership unpacked(const GridGeometry<Dim>& geometry,
                            std::span<const std::int64_t> packed);
  std::vector<std::int64_t> packed() const;

  const GridGeometry<Dim>& geometry() const { return geometry_; }
  int ranks() const { return int(bounds_.size()); }
  bool by_cuts() const { return edge_ == 0; }
  const Cuts& cuts() const { return cuts_; }
  /// Process grid of cuts; zeros for blocks.
  IndexVec<Dim> ranks_per_axis() const;
  LocalIndex block_edge() const { return edge_; }

  /// Owner of a cell or node, also of an image; outside the grid the nearest one's.
  int owner_of_cell(const IndexVec<Dim>& cell) const;
  /// The smallest box that holds all nodes that a rank owns: with cuts these and no others.
  const IndexBox<Dim>& owned(int rank) const { return bounds_[rank]; }
  /// `owned` and all that the stencils of particles in it reach, also after a step in which they
  /// have moved by up to one cell beyond it. On periodic axes it may go beyond the grid.
  IndexBox<Dim> local(int rank, int support) const;

 private:
  GridGeometry<Dim> geometry_;
  Cuts cuts_;
  LocalIndex edge_ = 0;  ///< of a block; 0: cuts
  IndexVec<Dim> blocks_ = IndexVec<Dim>::Zero();
  std::vector<int> rank_of_block_;
  std::vector<IndexBox<Dim>> bounds_;
};

/// Nodes up to which the stencil of a particle reaches below and above its cell's index, when it
/// may since have moved into a neighbouring cell.
struct StencilReach {
  LocalIndex below, above;

  /// A particle in cell i has its first node at i (linear) or i - 1 (wider functions) at the
  /// lowest, and its last at i + 1 or i + 2; a step moves it by less than a cell.
  explicit StencilReach(int support) : below(support == 2 ? 1 : 2), above(support == 2 ? 2 : 3) {}
};

}  // namespace mpm
