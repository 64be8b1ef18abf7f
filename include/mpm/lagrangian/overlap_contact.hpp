#pragma once
/// Contact of a body with itself and with others: a penalty on the area, in space on the volume, in
/// which surface cells lie upon each other, and Coulomb's friction.

#include <mpm/lagrangian/body_pairs.hpp>
#include <mpm/lagrangian/cell_overlaps.hpp>
#include <mpm/lagrangian/overlap_potential.hpp>
#include <mpm/lagrangian/self_contact.hpp>
#include <mpm/parallel/ghosts.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace mpm {

/// The potential is the sum over the cells c near surfaces of S_c V0 sum_d s_cd H(T_cd): s_cd is
/// what the share of c counts as on which cell d lies, which has no face in common with it, T_cd
/// that and those of d's neighbours on c, H what it stores (overlap_potential.hpp), V0 the volume
/// of a cell at rest (in the plane its area) and S_c = kappa C (in the plane times the thickness),
/// C the modulus of the fastest wave. The share is one of the cell as it is now, J V0 with J from
/// its corners: one that is pressed to a third of its volume is nine times as stiff, as its
/// material is. Across a flush face the pressure is about 2 kappa C times the depth over the size
/// of a cell as long as that is small, however the lattices of the two sides lie to each other;
/// what presses a cell from elsewhere does not enter but by J. No normals, no closest
/// features: what the corners bear is the derivative. A rigid cell has, with each cell it meets,
/// the stiffness of that one.
///
/// Each rank keeps the pairs of its own cells with others; of those on other ranks, and of
/// images across periodic sides, it holds copies.
template <int Dim>
class OverlapContact final : public SelfContact<Dim> {
  using Overlaps = CellOverlaps<Dim>;
  static constexpr std::size_t corners_of_cell = 1 << Dim;
  /// Of its volume at rest: a cell that has less, or is turned inside out, counts as this.
  static constexpr double least_squeezed = 0.1;

 public:
  using typename SelfContact<Dim>::Cell;
  using typename SelfContact<Dim>::Cells;

  /// This rank's cells near surfaces; `size` of a location, m, and `period` in locations.
  /// Collective.
  OverlapContact(MPI_Comm comm, Cells cells, double kappa, BodyPairs bodies, const Vec<Dim>& size,
                 const IndexVec<Dim>& period);

  void set_cells(Cells cells) override;
  void find_pairs(const MeshNodes<Dim>& nodes, std::vector<double> rooms) override;
  double reach() const override { return reach_; }
  double beyond_rooms(const MeshNodes<Dim>& nodes, std::span<const double> ahead) const override;
  void measure(const MeshNodes<Dim>& nodes) override;

  void add_forces(NodeFields<Dim>& fields) const override;
  void add_friction(const NodeFields<Dim>& fields, double dt, std::span<double> friction) override;
  void count_stiffness(std::span<LaneVector<double>> least_stretches, double way) override;
  void forget_stiffness() override;
  double energy() const override { return energy_; }
  double overlapped_area() const override;
  double deepest_overlap() const override;
  GlobalIndex touching() const override { return GlobalIndex(touches_.size()); }

  void visit_work(
      const std::function<void(const IndexVec<Dim>& location, double work)>& visit) const override;

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
  using Box = CellBox<Dim>;
  /// first: a cell of this rank.
  struct Pair {
    LocalIndex first, second;
    auto operator<=>(const Pair&) const = default;
  };
  /// Of a cell, `periods_` to either side, the first axis fastest: its own place is in the middle.
  int itself() const { return ((2 * periods_).array() + 1).prod() / 2; }
  LocalIndex cells() const { return LocalIndex(cells_.size()); }
  double* values_of(LocalIndex cell) { return &values_[std::size_t(cell) * Overlaps::values]; }
  const double* values_of(LocalIndex cell) const
  {
    return &values_[std::size_t(cell) * Overlaps::values];
  }
  void take_places(const MeshNodes<Dim>& nodes);
  /// Of a cell of this rank, or null.
  const CellOutline* outline_of(LocalIndex cell) const
  {
    const LocalIndex outline = cells_[std::size_t(cell)].outline;
    return outline < 0 ? nullptr : &outlines_[std::size_t(outline)];
  }
  /// In locations, the short way around where an axis is periodic.
  IndexVec<Dim> apart(const IndexVec<Dim>& from, const IndexVec<Dim>& to) const
  {
    IndexVec<Dim> apart = to - from;
    for (int d = 0; d < Dim; ++d)
      if (period_[d] > 0) {
        if (apart[d] > period_[d] / 2) apart[d] -= period_[d];
        if (apart[d] < -period_[d] / 2) apart[d] += period_[d];
      }
    return apart;
  }
  IndexVec<Dim> apart(LocalIndex from, LocalIndex to) const
  {
    return apart(locations_[std::size_t(from)], locations_[std::size_t(to)]);
  }
  /// Whether what a third cell presses two of these locations with adds up.
  bool are_of_one_wall(const IndexVec<Dim>& a, const IndexVec<Dim>& b) const
  {
    return apart(a, b).cwiseAbs().maxCoeff() <= 2;
  }
  bool can_meet(LocalIndex own, LocalIndex other) const;
  bool can_press(const Pair& pair, double way) const;
  void find_boxes();
  void count_images(std::span<const double> boxes);
  Vec<Dim> shift_of(int image) const;
  std::vector<Ghosts::Peer> add_candidates(std::vector<double>& rooms);
  void add_ghosts(std::vector<Ghosts::Peer>& peers, const std::vector<std::vector<double>>& sent,
                  std::vector<double>& rooms);
  void list_pairs(std::span<const double> rooms);
  void keep_needed(std::vector<Ghosts::Peer> peers);
  void answer(std::vector<Ghosts::Peer>& peers, const std::vector<std::vector<double>>& asked,
              std::vector<Ghosts::Peer>& sides) const;
  void list_close();
  void list_near();
  void list_pressing();
  void list_touched();
  void list_touches();
  std::vector<double> counted_work() const;
  void take_motion(const NodeFields<Dim>& fields);

  /// A listed pair whose boxes may meet before one has gone far.
  struct Close {
    /// In the order of their locations, so that both ranks of a pair find the same bits.
    std::array<LocalIndex, 2> cells;
    LocalIndex pair;     ///< among pairs_
    LocalIndex touched;  ///< among touched_, or -1
  };
  /// A pair that has touched since the last check, and the largest of that time for either cell:
  /// G'' times the face on which it is pressed over that of a cell; and the share that the other
  /// cell has in what lies on this one's face.
  struct Touched {
    std::array<LocalIndex, 2> cells;
    LocalIndex pair;
    double stiffness[2], share[2];
  };
  /// A close pair that touches now. What every step goes through is kept together, and small: the
  /// pairs that are listed do not fit into a processor's caches.
  struct Pressing {
    std::array<LocalIndex, 2> cells;
    LocalIndex close, touched;
    LocalIndex first, end;  ///< entries of found_
    double overlap;         ///< m^3, in the plane m^2
    double face;            ///< what the overlap gains per way of a cell, m^2 or m
    double pressure;        ///< of both cells' answers, Pa, in the plane N/m
  };
  /// visit(entry, pair) of found_, where it has an overlap.
  template <class Visit>
  void for_each_overlap(const Visit& visit) const
  {
    for (const Pressing& pair : pressing_)
      for (auto entry = std::size_t(pair.first); entry < std::size_t(pair.end); ++entry)
        if (found_.overlap(entry) > 0) visit(entry, pair);
  }
  bool is_with_a_copy(const std::array<LocalIndex, 2>& pair) const
  {
    return std::max(pair[0], pair[1]) >= cells();
  }

  /// One cell of this rank in a pair that touches.
  struct Touch {
    LocalIndex other;
    LocalIndex pressing;  ///< twice the place in pressing_, and one more for its second cell
    double overlap, face;
  };
  /// Of a touch: what its overlap counts as, how that grows with it, and with those of one wall
  /// the sums of these and of faces.
  struct Part {
    IndexVec<Dim> location;  ///< of the other cell
    double share, slope, together, face;
    double answer;  ///< derivative of the energy by the share, over S_c V0
    double change;  ///< by how much its neighbours' answers grow with its share
  };
  /// Of a cell of this rank, after measure().
  std::span<const Touch> touches_of(LocalIndex cell) const
  {
    const auto c = std::size_t(cell);
    return {touches_.data() + first_touch_[c], touches_.data() + first_touch_[c + 1]};
  }
  bool is_rigid(LocalIndex cell) const { return stiffness_[std::size_t(cell)] == 0; }
  void answer_overlaps(std::size_t cell, std::span<const Touch> touches);
  void trade_answers();

  MPI_Comm comm_;
  Ghosts ghosts_, side_ghosts_;
  std::vector<Cell> cells_;
  std::vector<CellOutline> outlines_;
  double reach_ = Overlaps::reach;
  BodyPairs bodies_;
  Vec<Dim> size_;
  IndexVec<Dim> period_;
  IndexVec<Dim> periods_ = IndexVec<Dim>::Zero();  ///< that an image may lie away
  double cell_volume_;                             ///< m^3, in the plane m^2, of a cell at rest
  double cell_face_;                               ///< m^2, in the plane m, of a side of it

  /// Of this rank's cells, then of the ghosts.
  LaneVector<double> values_;  ///< [n * Overlaps::values], m
  LaneVector<Box> boxes_;
  std::vector<double> stiffness_;
  std::vector<IndexVec<Dim>> locations_;
  std::vector<OpenCorners<Dim>> open_;
  std::vector<int> of_body_;
  std::vector<int> images_;

  std::vector<Pair> pairs_;
  std::vector<char> turned_;            ///< whether the second stands first in Close
  std::vector<LocalIndex> touched_at_;  ///< of a pair among touched_, or -1
  std::vector<Close> close_;
  LaneVector<Box> boxes_then_;      ///< when those were listed
  std::vector<MeetingCells> near_;  ///< those whose boxes meet
  Overlaps found_;                  ///< theirs
  std::vector<Pressing> pressing_;  ///< in the order of found_
  std::vector<Touched> touched_;
  /// What ranks tell each other of a pair: of each this rank's, a zero, then the other ranks' as
  /// `other_side_` has them. All are 0 but for a moment.
  std::vector<double> sides_;
  std::vector<LocalIndex> other_side_;
  /// Of the touches of one cell, for a moment, and those of one wall.
  std::vector<Part> parts_;
  std::vector<std::array<std::size_t, 2>> beside_;
  std::vector<Touch> touches_;  ///< of cell c from first_touch_[c] on
  std::vector<LocalIndex> first_touch_, next_touch_;
  std::vector<double> motion_;         ///< of the cells' corners, with friction
  std::vector<Vec<Dim>> places_then_;  ///< of nodes, m, when the pairs were found
  std::vector<double> rooms_then_;     ///< theirs, m
  /// As last counted, while pairs have been found and not measured yet.
  std::vector<double> work_then_;
  double energy_ = 0;  ///< J, of this rank's cells
  double kappa_;
  /// Of cells that touch, the derivative of the energy by their volume, with its sign turned, Pa or
  /// N/m.
  std::vector<double> swelling_;
};

}  // namespace mpm
