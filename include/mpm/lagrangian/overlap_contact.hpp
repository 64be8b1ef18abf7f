#pragma once
/// Contact of a body with itself and with others in the plane, without friction: a penalty on the
/// area on which surface cells lie upon each other.

#include <mpm/core/lane_vector.hpp>
#include <mpm/core/lanes.hpp>
#include <mpm/grid/mesh_nodes.hpp>
#include <mpm/parallel/ghosts.hpp>

#include <array>
#include <span>
#include <vector>

namespace mpm {

/// The potential is the sum over the cells near surfaces of S_c A_c^2 / (2 A0), with A_c the sum of the
/// areas on which other cells lie on it that have no side in common with it, A0 the area of a cell
/// at rest and S_c = kappa C times the thickness, C the modulus of the fastest wave: across a flush
/// face its pressure is 2 kappa C times the depth over the size of a cell, however the lattices of
/// the two sides lie to each other. No normals, no closest features: what the corners bear is its
/// derivative.
///
/// Each rank keeps the pairs of its own cells with others; of those on other ranks, and of
/// images across periodic sides, it holds copies.
class OverlapContact {
 public:
  struct Cell {
    std::array<LocalIndex, 4> nodes;  ///< counter-clockwise
    IndexVec<2> location;
    double stiffness;  ///< S_c, N/m
    double mass;       ///< kg
    /// Bit k: on one side at least of the diagonal neighbour towards corner k (bit 0 of k: upper
    /// along x, bit 1: along y) there is nothing. 0: a cell behind the outer layer.
    unsigned open_corners;
  };

  /// This rank's cells near surfaces; `size` of a location, m, and `period` in locations; `damping`
  /// over that at which an overlap would go back without a swing.
  OverlapContact(MPI_Comm comm, std::vector<Cell> cells, const Vec<2>& size,
                 const IndexVec<2>& period, double damping);

  /// Finds all pairs that can meet before a node has moved by half of `skin`, m. Collective.
  void find_pairs(const MeshNodes<2>& nodes, double skin);
  double skin() const { return skin_; }
  /// The largest way of a node of this rank's since then, m.
  double largest_way(const MeshNodes<2>& nodes) const;
  /// Overlaps at the present places. Every rank calls it.
  void measure(const MeshNodes<2>& nodes);

  // At the last call of `measure`, of this rank's cells.
  void add_forces(NodeFields<2>& fields) const;
  /// Adds forces against the change of the overlaps in the last step, of `dt`, to the fields and to
  /// `forces`, N, [2 * nodes]. They never pull.
  void add_damping(NodeFields<2>& fields, double dt, std::span<double> forces) const;
  double energy() const;           ///< J
  double overlapped_area() const;  ///< m^2; every overlap counts once on either cell, half each
  GlobalIndex touching() const { return touching_; }  ///< pairs, with others' halves

  const Ghosts& ghosts() const { return ghosts_; }
  std::size_t bytes() const;

 private:
  /// first: a cell of this rank.
  struct Pair {
    LocalIndex first, second;
    auto operator<=>(const Pair&) const = default;
  };
  static constexpr int corner_values = 8;  ///< x and y of the corners
  /// Of lane_count pairs: areas, and their derivatives by 16 coordinates.
  static constexpr int values_per_group = 17 * lane_count;
  const double* overlap_of_pair(std::size_t k) const
  {
    return &overlaps_[k / lane_count * values_per_group + k % lane_count];
  }

  LocalIndex cells() const { return LocalIndex(cells_.size()); }
  double* corners_of(LocalIndex cell) { return &corners_[std::size_t(cell) * corner_values]; }
  void take_places(const MeshNodes<2>& nodes);
  bool can_meet(LocalIndex own, LocalIndex other) const;
  void find_boxes();
  Vec<2> shift_of(int image) const;
  std::vector<Ghosts::Peer> add_candidates(double skin);
  void list_pairs(double skin);
  void keep_needed(std::vector<Ghosts::Peer> peers);
  void find_overlaps();
  template <class Push>
  void for_each_touching(const Push& push) const;

  MPI_Comm comm_;
  Ghosts ghosts_;
  std::vector<Cell> cells_;
  Vec<2> size_;
  IndexVec<2> period_;
  double area_;  ///< m^2, of a cell at rest
  double damping_;
  double skin_ = 0;

  /// Of this rank's cells, then of the ghosts.
  std::vector<double> corners_;   ///< [n * corner_values], m
  std::vector<std::array<double, 4>> boxes_;  ///< lower x, lower y, upper x, upper y, m
  std::vector<double> pressure_;  ///< [n]: S_c A_c / A0, N/m
  std::vector<double> stiffness_;
  std::vector<IndexVec<2>> locations_;
  std::vector<unsigned> open_corners_;

  std::vector<Pair> pairs_;
  std::vector<std::size_t> near_;   ///< those whose boxes meet
  std::vector<double> areas_, areas_before_;  ///< of all pairs, m^2
  LaneVector<double> overlaps_;   ///< per lane_count pairs in near_: area and its 16 derivatives
  std::array<std::vector<double>, 2> places_then_;  ///< of nodes, m, when the pairs were found
  GlobalIndex touching_ = 0;
};

}  // namespace mpm
