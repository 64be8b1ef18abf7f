#pragma once
/// Contact of a body with itself and with others in the plane: a penalty on the area on which
/// surface cells lie upon each other, and Coulomb's friction.

#include <mpm/core/lane_vector.hpp>
#include <mpm/core/lanes.hpp>
#include <mpm/lagrangian/overlap_potential.hpp>
#include <mpm/lagrangian/self_contact.hpp>
#include <mpm/parallel/ghosts.hpp>

#include <array>
#include <span>
#include <vector>

namespace mpm {

/// The potential is the sum over the cells c near surfaces of S_c A0 sum_d s_cd H(T_cd): s_cd is
/// what the share of c counts as on which cell d lies, which has no side in common with it, T_cd
/// that and those of d's neighbours on c, H what it stores (overlap_potential.hpp), A0 the area of
/// a cell at rest and S_c = kappa C times the thickness, C the modulus of the fastest wave. Across
/// a flush face the pressure is about 2 kappa C times the depth over the size of a cell as long as
/// that is small, however the lattices of the two sides lie to each other; what presses a cell from
/// elsewhere does not enter. No normals, no closest features: what the corners bear is the
/// derivative.
///
/// Each rank keeps the pairs of its own cells with others; of those on other ranks, and of
/// images across periodic sides, it holds copies.
class OverlapContact final : public SelfContact<2> {
 public:
  struct Cell {
    std::array<LocalIndex, 4> nodes;  ///< counter-clockwise
    IndexVec<2> location;
    double stiffness;  ///< S_c, N/m
    /// Bit k: on one side at least of the diagonal neighbour towards corner k (bit 0 of k: upper
    /// along x, bit 1: along y) there is nothing. 0: a cell behind the outer layer.
    unsigned open_corners;
    int body;             ///< whose cell it is
    LocalIndex particle;  ///< and which
  };

  /// This rank's cells near surfaces; `size` of a location, m, and `period` in locations.
  OverlapContact(MPI_Comm comm, std::vector<Cell> cells, double kappa, const Vec<2>& size,
                 const IndexVec<2>& period);

  void find_pairs(const MeshNodes<2>& nodes, double skin) override;
  double skin() const override { return skin_; }
  double largest_way(const MeshNodes<2>& nodes) const override;
  void measure(const MeshNodes<2>& nodes) override;

  void add_forces(NodeFields<2>& fields) const override;
  void add_friction(const NodeFields<2>& fields, double coefficient, double dt,
                    std::span<double> friction) override;
  void count_stiffness(std::span<LaneVector<double>> least_stretches) override;
  double energy() const override { return energy_; }
  double overlapped_area() const override;
  GlobalIndex touching() const override { return touching_; }

  GlobalIndex messages() const override { return ghosts_.messages() + side_ghosts_.messages(); }
  GlobalIndex bytes_sent() const override
  {
    return ghosts_.bytes_sent() + side_ghosts_.bytes_sent();
  }
  double waiting_seconds() const override
  {
    return ghosts_.waiting_seconds() + side_ghosts_.waiting_seconds();
  }
  std::size_t bytes() const override;

 private:
  /// first: a cell of this rank.
  struct Pair {
    LocalIndex first, second;
    auto operator<=>(const Pair&) const = default;
  };
  /// Parts of a pair's cells: 0 is all of one, the others are triangles. Those of the cell that
  /// comes first in the order of locations are first.
  struct Near {
    std::size_t pair;
    int first_piece, second_piece;
  };
  static constexpr int corner_values = 8;  ///< x and y of the corners
  /// Of lane_count pairs: areas, and their derivatives by 16 coordinates.
  static constexpr int values_per_group = 17 * lane_count;
  const double* overlap_of_pair(std::size_t k) const  // of near_[k]
  {
    return &overlaps_[k / lane_count * values_per_group + k % lane_count];
  }

  /// Lower x, lower y, upper x, upper y, m.
  using Box = std::array<double, 4>;
  /// Whether boxes are nearer than `distance`.
  static bool meet(const Box& a, const Box& b, double distance)
  {
    return a[0] < b[2] + distance && b[0] < a[2] + distance && a[1] < b[3] + distance &&
           b[1] < a[3] + distance;
  }

  LocalIndex cells() const { return LocalIndex(cells_.size()); }
  double* corners_of(LocalIndex cell) { return &corners_[std::size_t(cell) * corner_values]; }
  void take_places(const MeshNodes<2>& nodes);
  IndexVec<2> apart(LocalIndex from, LocalIndex to) const;
  bool can_meet(LocalIndex own, LocalIndex other) const;
  bool are_of_one_wall(LocalIndex a, LocalIndex b) const;
  void find_boxes();
  Vec<2> shift_of(int image) const;
  std::vector<Ghosts::Peer> add_candidates(double skin);
  void list_pairs(double skin);
  void keep_needed(std::vector<Ghosts::Peer> peers);
  void answer(std::vector<Ghosts::Peer>& peers, const std::vector<std::vector<double>>& asked,
              std::vector<Ghosts::Peer>& sides) const;
  void list_near();
  void find_overlaps();
  void take_motion(const NodeFields<2>& fields);
  static const std::array<std::size_t, 4>& corners_of_piece(int piece);

  /// One cell of this rank in a pair that touches.
  struct Touch {
    LocalIndex other, pair, side;  ///< side: where in sides_
  };
  /// What a touch stores, and by how much its neighbours' answers grow with it.
  struct Part {
    double own, change;
  };
  double share_of(const Touch& touch) const
  {
    return OverlapShare(areas_[std::size_t(touch.pair)] / area_).value;
  }
  static double face_length(const double* derivative);
  void answer_overlaps(std::size_t cell, std::span<const Touch> touches);
  /// What presses in a pair, of both its sides, N/m.
  double pressure(std::size_t pair) const
  {
    return OverlapShare(areas_[pair] / area_).slope *
           (sides_[pair] + sides_[std::size_t(second_side_[pair])]);
  }

  MPI_Comm comm_;
  Ghosts ghosts_, side_ghosts_;
  std::vector<Cell> cells_;
  Vec<2> size_;
  IndexVec<2> period_;
  double area_;  ///< m^2, of a cell at rest
  double skin_ = 0;

  /// Of this rank's cells, then of the ghosts.
  std::vector<double> corners_;  ///< [n * corner_values], m
  std::vector<Box> boxes_;
  std::vector<double> stiffness_;
  std::vector<IndexVec<2>> locations_;
  std::vector<unsigned> open_corners_;
  std::vector<int> images_;

  std::vector<Pair> pairs_;
  /// Whether the overlap is found as that of the second with the first: in the order of their
  /// locations, so that both ranks of a pair find the same bits.
  std::vector<char> turned_;
  std::vector<Near> near_;       ///< those whose boxes meet
  std::vector<double> areas_;    ///< of all pairs, m^2
  std::vector<double> lengths_;  ///< of their faces, m: what one cell's overlap gains per way of it
  /// Of every pair what its first cell answers with, the derivative of its energy by the overlap,
  /// N/m, a zero, and the second cells' as `second_side_` has them: other ranks' last.
  std::vector<double> sides_;
  std::vector<LocalIndex> second_side_;
  std::vector<Part> parts_;     ///< of the touches of one cell, for a moment
  std::vector<Touch> touches_;  ///< of cell c from first_touch_[c] on
  std::vector<LocalIndex> first_touch_;
  std::vector<double> motion_;   ///< of the cells' corners, with friction
  LaneVector<double> overlaps_;  ///< per lane_count pairs in near_: area and its 16 derivatives
  std::array<std::vector<double>, 2> places_then_;  ///< of nodes, m, when the pairs were found
  GlobalIndex touching_ = 0;
  double energy_ = 0;  ///< J, of this rank's cells
  double kappa_;
  /// As sides_, the largest since the last check: G'' times the length on which it presses over the
  /// size of a cell; and the share that the other cell has in what lies on this one's face.
  std::vector<double> stiffnesses_, parts_of_face_;
};

}  // namespace mpm
