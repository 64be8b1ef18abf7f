#pragma once
/// Forces from outside.

#include <mpm/grid/node_fields.hpp>
#include <mpm/materials/body.hpp>

#include <limits>

namespace mpm {

/// Acts either on nodes, where the force follows from what they carry, or on particles, from which
/// it is mapped to the nodes with their weights.
template <int Dim>
class Load {
 public:
  virtual ~Load() = default;

  virtual bool acts_on_particles() const = 0;
  /// Adds the force (N) in the step from `time` to `time + dt` to the load force of every active
  /// node. Nodes hold their whole mass and momentum, on each rank that reaches them.
  virtual void add_to_nodes(const Nodes<Dim>&, std::span<const NodeRun<Dim>>, NodeFields<Dim>&,
                            double /*time*/, double /*dt*/) const
  {
  }
  /// Adds the force (N) at `time` on the particles of one block of a body.
  virtual void add_to_particles(const Body<Dim>&, LocalIndex /*block*/, double /*time*/,
                                Lanes (&)[Dim]) const
  {
  }
  /// s, that the load bears.
  virtual double largest_step() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace mpm
