#pragma once
/// All loads of a run together, and the work that they do.

#include <mpm/conditions/load.hpp>
#include <mpm/conditions/reaction.hpp>
#include <mpm/transfer/transfer.hpp>

#include <memory>
#include <span>
#include <vector>

namespace mpm {

template <int Dim>
class Loads {
 public:
  Loads() = default;
  explicit Loads(std::vector<std::unique_ptr<Load<Dim>>> loads);

  bool empty() const { return loads_.empty(); }
  bool act_on_particles() const { return on_particles_; }
  std::vector<SurfaceMark<Dim>> marks() const;
  bool need_initial_position() const;

  /// P2G of the forces on particles: a partial sum, as other node values.
  void scatter(const BodyPart<Dim>& part, const Transfer<Dim>& transfer,
               const GridTopology<Dim>& grid, NodeFields<Dim>& fields, double time) const;
  std::span<const std::unique_ptr<Load<Dim>>> all() const { return loads_; }
  using Runs = std::span<const NodeRun<Dim>>;
  /// Adds the forces on nodes, and all load forces to the nodes' force.
  void apply(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields, double time,
             double dt) const;
  /// Once the nodes' velocities of the step are known: impulse f dt, and work f dt times the mean
  /// velocity of the step; of owned nodes.
  void book(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields, double dt);

  /// Work on the residual velocity that a refinement (NodeFields::refine) has added.
  void book_residual(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields, double dt);

  Reaction<Dim> take_reaction() { return reaction_.take(); }
  double largest_step() const;
  void archive(Archive& archive) { reaction_.archive(archive); }

 private:
  template <class Visit>
  void for_each_impulse(const Nodes<Dim>& nodes, Runs runs, NodeFields<Dim>& fields, double dt,
                        Visit visit);

  std::vector<std::unique_ptr<Load<Dim>>> loads_;
  bool on_particles_ = false;
  Reaction<Dim> reaction_;
};

}  // namespace mpm
