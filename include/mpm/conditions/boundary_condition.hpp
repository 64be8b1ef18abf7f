#pragma once
/// Velocity constraints on nodes and the reactions they meet with.

#include <mpm/conditions/reaction.hpp>
#include <mpm/grid/mesh_nodes.hpp>
#include <mpm/grid/node_fields.hpp>
#include <mpm/materials/body.hpp>
#include <mpm/transfer/scheme.hpp>

namespace mpm {

template <int Dim>
class BoundaryCondition {
 public:
  explicit BoundaryCondition(ReactionBook book) : book_(book) {}
  virtual ~BoundaryCondition() = default;

  /// Sets the updated velocities of its nodes for the step from `time` to `time + dt`, and books
  /// the reaction.
  virtual void constrain_updated(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                                 double dt) = 0;
  /// Sets the velocities whose gradient is taken.
  virtual void constrain_gradient(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                                  double dt) = 0;

  /// For nodes that move with a body: sets the updated velocities of those that are held, and of
  /// those that the step from `time` to `time + dt` would take behind a face, and books the
  /// reaction.
  virtual void stop(const MeshNodes<Dim>&, NodeFields<Dim>&, double /*time*/, double /*dt*/) {}
  /// Whether `stop` lets what it stops rub along the face, and what that has turned to heat since
  /// the start at this rank's nodes, J.
  virtual bool rubs() const { return false; }
  virtual double friction_work() const { return 0; }

  /// Whether it pushes the particles that reach behind a face, and never holds them: it then
  /// leaves the nodes alone.
  virtual bool pushes() const { return false; }
  /// Adds the force (N) at `time` on the particles of one block of a body, and remembers it.
  /// Returns whether there is any.
  virtual bool push(const Body<Dim>&, LocalIndex /*block*/, double /*time*/, Lanes (&)[Dim])
  {
    return false;
  }
  /// What the step from `time` to `time + dt`, begun with the forces remembered, does with them.
  virtual void book_push(double /*time*/, double /*dt*/) {}
  /// Forgets the forces: those of the next step come.
  virtual void reset_push() {}
  /// What a body that is pushed stores in its contact at `time`.
  virtual ContactSums stored(const Body<Dim>&, double /*time*/) const { return {}; }

  /// Returns what was booked and starts again from zero.
  Reaction<Dim> take_reaction() { return reaction_.take(); }
  /// All that it keeps from one step to the next: `archive_reaction`, and what is its own.
  virtual void archive(Archive& archive) = 0;

 protected:
  void archive_reaction(Archive& archive) { reaction_.archive(archive); }

  /// One component of one node follows a wall whose velocity goes from `before` to `after` in this
  /// step. The reaction counts on the node's owner only.
  void constrain(NodeFields<Dim>& fields, LocalIndex node, bool owned, int component, double before,
                 double after)
  {
    double* u = fields.updated_of(node);
    const double free_velocity = (1 - book_.velocity_share) * (before + u[Dim + component]) +
                                 book_.velocity_share * u[component];
    u[component] = after;
    u[Dim + component] = after - before;
    if (!owned) return;
    const double impulse = fields.mass_of(node) * (after - free_velocity);
    reaction_.impulse[component] += impulse;
    reaction_.work += impulse * 0.5 * (before + after);
  }

  /// One component of one node that moves with a body gets this velocity. What it brought along
  /// beyond it is lost, as in an impact: the work is the one done on the node. Returns it, J.
  double drive(NodeFields<Dim>& fields, LocalIndex node, bool owned, int component, double velocity)
  {
    double* u = fields.updated_of(node);
    const double impulse = fields.mass_of(node) * (velocity - u[component]);
    const double before = u[component] - u[Dim + component];
    u[component] = velocity;
    u[Dim + component] = velocity - before;
    if (!owned) return 0;
    const double work = impulse * 0.5 * (before + velocity);
    reaction_.impulse[component] += impulse;
    reaction_.work += work;
    return work;
  }

  /// A force (N) on the body along an axis throughout a step, by what moves with this velocity.
  void book_force(int axis, double force, double velocity, double dt)
  {
    reaction_.impulse[axis] += dt * force;
    reaction_.work += dt * force * velocity;
  }

 private:
  ReactionBook book_;
  Reaction<Dim> reaction_;
};

}  // namespace mpm
