#pragma once
/// Velocity constraints on grid nodes and the reactions they meet with.

#include <mpm/grid/node_grid.hpp>
#include <mpm/transfer/scheme.hpp>

#include <utility>

namespace mpm {

/// What a condition gave to the body since the last `take_reaction`, this rank's nodes only.
template <int Dim>
struct Reaction {
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< N s, on the body
  double work = 0;                      ///< J, done on the body
};

template <int Dim>
class BoundaryCondition {
 public:
  explicit BoundaryCondition(ReactionBook book) : book_(book) {}
  virtual ~BoundaryCondition() = default;

  /// Sets the updated velocities of its nodes for the step from `time` to `time + dt`, and books
  /// the reaction.
  virtual void constrain_updated(NodeGrid<Dim>& grid, double time, double dt) = 0;
  /// Sets the velocities whose gradient is taken.
  virtual void constrain_gradient(NodeGrid<Dim>& grid, double time, double dt) = 0;

  /// Returns what was booked and starts again from zero.
  Reaction<Dim> take_reaction() { return std::exchange(reaction_, Reaction<Dim>{}); }

 protected:
  /// One component of one node follows a wall whose velocity goes from `before` to `after` in this
  /// step. The reaction counts on the node's owner only.
  void constrain(NodeGrid<Dim>& grid, LocalIndex node, bool owned, int component, double before,
                 double after)
  {
    double* u = grid.updated_of(node);
    const double free_velocity =
        book_ == ReactionBook::increments ? before + u[Dim + component] : u[component];
    u[component] = after;
    u[Dim + component] = after - before;
    if (!owned) return;
    const double impulse = grid.mass[node] * (after - free_velocity);
    reaction_.impulse[component] += impulse;
    reaction_.work += impulse * 0.5 * (before + after);
  }

 private:
  ReactionBook book_;
  Reaction<Dim> reaction_;
};

}  // namespace mpm
