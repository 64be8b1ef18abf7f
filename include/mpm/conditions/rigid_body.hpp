#pragma once
#include <mpm/conditions/boundary_condition.hpp>
#include <mpm/conditions/wall_motion.hpp>

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

namespace mpm {

/// A body of material `rigid` that moves with a prescribed velocity: every node on or inside it
/// moves with it (sticking), as behind a rigid wall. Its points are known at all times without
/// being stepped, so every rank keeps all of them, and asks them about its own nodes only. (In a
/// total Lagrangian step such bodies are cells: lagrangian/rigid_cells.hpp.)
template <int Dim>
class RigidBody final : public BoundaryCondition<Dim> {
 public:
  /// `points`: centres at time 0 of boxes with half edges `half_size` that fill the body, m.
  RigidBody(const std::vector<Vec<Dim>>& points, const Vec<Dim>& half_size,
            const std::array<WallMotion, Dim>& motion, ReactionBook book);

  void constrain_updated(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                         double dt) override;
  void constrain_gradient(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                          double dt) override;
  /// Where it is follows from the time.
  void archive(Archive& archive) override { this->archive_reaction(archive); }

 private:
  void find_nodes(const Nodes<Dim>& nodes, double time);
  /// Whether a place, counted from where the body was at time 0, is on or inside a box.
  bool holds(const Vec<Dim>& place, const Vec<Dim>& tolerance) const;
  /// The same of any of its images; `period` is 0 along axes that are not periodic.
  bool holds_image(const Vec<Dim>& place, const Vec<Dim>& period, const Vec<Dim>& tolerance) const;
  IndexVec<Dim> bucket_of(const Vec<Dim>& place) const;
  static GlobalIndex key_of(const IndexVec<Dim>& bucket);

  std::unordered_map<GlobalIndex, std::vector<Vec<Dim>>> buckets_;  ///< of the size of a box
  Region<Dim> bounds_;                                              ///< of all boxes at time 0
  Vec<Dim> half_size_;
  std::array<WallMotion, Dim> motion_;
  /// What the nodes that were found last depend on.
  struct Found {
    GlobalIndex listing;
    Vec<Dim> moved;  ///< m
  };
  std::optional<Found> found_for_;
  std::vector<LocalIndex> near_, found_;  ///< found: nodes on and inside the body, ascending
};

}  // namespace mpm
