#pragma once
/// The stages of which the update orders are made.

#include <mpm/stepping/exchange.hpp>
#include <mpm/stepping/slots.hpp>

#include <vector>

namespace mpm {

/// What a step does beside what its order says.
struct StepExtras {
  int refinements = 0;                ///< of the velocity, for a scheme that refines
  bool refine_before_forces = false;  ///< only what the velocity was before the forces
  bool f_bar = false;                 ///< the stress sees means of the divergence
  /// Whether the nodes hold a re-mapped momentum for them.
  bool remap() const { return refinements > 0 || f_bar; }
};

/// Everything that a step works on. A body moves in the velocity field that it names.
template <int Dim>
struct Step {
  using Fields = NodeFields<Dim>;

  Exchange<Dim>& exchange;
  const Transfer<Dim>& transfer;
  std::vector<Body<Dim>>& bodies;
  std::vector<NodeFields<Dim>>& fields;
  Slots<Dim>& slots;
  const StepExtras& extras;
  Moment moment;
  bool surfaces_found = false;  ///< in this step

  const GridTopology<Dim>& grid() const { return exchange.topology(); }
  NodeFields<Dim>& fields_of(const BodyPart<Dim>& part) const { return fields[part.body.field]; }
  double time() const { return moment.time; }

  /// v_i = ((mv)_i + dt f_i) / m_i with the loads' forces; contact and conditions; refinements.
  void update_velocity(double dt);
  /// G2P of the updated velocity, and the gradient velocity from the momentum that it has once the
  /// particles map it back.
  void remap_velocity();
  /// Velocities whose gradient is taken, at time() + dt: contact and conditions.
  void constrain_gradient(double dt);
  /// F-bar, once the gradient velocities stand: the mean of their divergence around every node,
  /// over the particles by mass, is what particles take in the stress update in place of their own.
  void average_divergence();
  /// Every field's sums, and what conditions push with, become zero.
  void reset();

  /// One of the columns of every field.
  using ColumnOf = NodeColumn (NodeFields<Dim>::*)();
  std::vector<NodeColumn> columns(std::initializer_list<ColumnOf> which) const;
  /// Mass and momentum, and the load force that particles will bring.
  std::vector<NodeColumn> sums(std::initializer_list<ColumnOf> which) const;
  /// Once a part has moved: P2G of the loads and pushes on its particles, for the next step.
  PassOutcome<Dim> with_forces(const BodyPart<Dim>& part, double dt, PassOutcome<Dim> moved) const
  {
    slots.scatter(part, transfer, grid(), fields_of(part), time() + dt);
    return moved;
  }

 private:
  void refine_velocity(double dt);
  /// Once, at the places where the step begins: what contact needs to know of the surfaces.
  void find_surfaces();
  /// A pass that adds to the re-mapped momentum, from zero.
  using RemapPass = PassOutcome<Dim> (Transfer<Dim>::*)(const BodyPart<Dim>&,
                                                        const GridTopology<Dim>&,
                                                        NodeFields<Dim>&) const;
  void sum_remap(RemapPass pass);
};

}  // namespace mpm
