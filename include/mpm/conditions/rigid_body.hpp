#pragma once
#include <mpm/conditions/boundary_condition.hpp>

#include <vector>

namespace mpm {

/// A body of material `rigid` that moves with constant velocity: every node on or inside it moves
/// with it (sticking), as behind a rigid wall. Its points are known at all times without being
/// stepped, so every rank keeps all of them and looks at those in its own nodes' range.
template <int Dim>
class RigidBody final : public BoundaryCondition<Dim> {
 public:
  /// `points`: centres at time 0 of boxes with half edges `half_size` that fill the body, m.
  RigidBody(std::vector<Vec<Dim>> points, const Vec<Dim>& half_size, const Vec<Dim>& velocity,
            ReactionBook book);

  void constrain_updated(NodeGrid<Dim>& grid, double time, double dt) override;
  void constrain_gradient(NodeGrid<Dim>& grid, double time, double dt) override;

 private:
  void mark_nodes(const NodeGrid<Dim>& grid, double time);

  std::vector<Vec<Dim>> points_;
  Vec<Dim> half_size_, velocity_;
  std::vector<LocalIndex> nodes_;  ///< inside the body, active, ascending
};

}  // namespace mpm
