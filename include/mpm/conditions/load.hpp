#pragma once
/// Forces from outside.

#include <mpm/grid/node_fields.hpp>
#include <mpm/materials/body.hpp>

#include <limits>
#include <optional>
#include <string>

namespace mpm {

/// Particles that a load acts on alone: the outermost of every row of particles along an axis, seen
/// from one end of it, that lie in a region at the start.
template <int Dim>
struct SurfaceMark {
  int load;  ///< its number
  int axis;
  bool upper;          ///< seen from the upper end
  Region<Dim> within;  ///< m

  /// Of the particles: the area of their face at the start, m^2; 0 for those that are not marked.
  std::string column() const { return "loaded_area_" + std::to_string(load); }
};

/// Acts either on nodes, where the force follows from what they carry, or on particles, from which
/// it is mapped to the nodes with their weights.
template <int Dim>
class Load {
 public:
  virtual ~Load() = default;

  virtual bool acts_on_particles() const = 0;
  /// Whether particles must know where they were at t = 0: column `initial_position`.
  virtual bool needs_initial_position() const { return false; }
  virtual std::optional<SurfaceMark<Dim>> mark() const { return std::nullopt; }
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
