#pragma once
/// The passes over the particles of which the update orders are made.

#include <mpm/grid/node_fields.hpp>
#include <mpm/materials/body.hpp>
#include <mpm/transfer/schemes.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mpm {

/// What ends a run at a particle.
enum class Fault : int {
  astray,         ///< it went where this rank's nodes do not reach, or is no longer a number
  inverted,       ///< det(I + dt L) of a step is not positive
  beyond_bounds,  ///< its volume ratio is, materials/present_deformation.hpp
};

template <int Dim>
struct LostParticle {
  GlobalIndex id;
  Vec<Dim> position = Vec<Dim>::Zero();  ///< m
  Vec<Dim> velocity = Vec<Dim>::Zero();  ///< m/s
  Fault fault = Fault::astray;
  double ratio = 1;  ///< of volumes: det(I + dt L) where inverted, J where beyond bounds
};

/// Place and velocity of a particle as they are.
template <int Dim>
LostParticle<Dim> lost_particle(const ParticleStore& particles, LocalIndex particle)
{
  const int position = particles.motion().find("position");
  const int velocity = particles.motion().find("velocity");
  LostParticle<Dim> lost{.id = particles.ids()[particle]};
  for (int d = 0; d < Dim; ++d) {
    lost.position[d] = particles.motion()(position + d, particle);
    lost.velocity[d] = particles.motion()(velocity + d, particle);
  }
  return lost;
}

/// What a pass found out on the way.
template <int Dim>
struct PassOutcome {
  double largest_speed = 0;  ///< m/s, largest component of a grid velocity, where it moves
  std::optional<LostParticle<Dim>> lost;
};

/// Where stencils still lie on this rank's nodes, m; particles beyond are put in the middle.
template <int Dim>
struct MoveBounds {
  Vec<Dim> reach_lower, reach_upper;
};

/// Blocks [first, end) of a body: a step may do those near other ranks before the rest.
template <int Dim>
struct BodyPart {
  Body<Dim>& body;
  LocalIndex first, end;
  bool interior = false;  ///< no stencil reaches beyond a wall at rest

  BodyPart(Body<Dim>& whole) : body(whole), first(0), end(whole.particles.blocks()) {}
  BodyPart(Body<Dim>& of, LocalIndex from, LocalIndex to, bool is_interior = false)
      : body(of), first(from), end(to), interior(is_interior)
  {
  }
};

/// What a scene may say of shape functions and schemes.
struct TransferOptions {
  double domain;         ///< size of a particle's domain at rest, in cells (GIMP, CPDI)
  double pic_share = 0;  ///< of the grid's velocity in that of schemes that take increments
  /// Velocity gradients that the stress sees have the divergence that the nodes hold
  /// (NodeFields::divergence_from_remap) in place of their own.
  bool f_bar = false;
};

/// Textbook names: P2G, G2P. Each pass is compiled for one dimension, shape function and scheme;
/// materials enter through Law. "Old place" and "new place" are before and after the move.
template <int Dim>
class Transfer {
 public:
  virtual ~Transfer() = default;

  virtual std::vector<Column> motion_columns(bool musl) const = 0;
  /// Nodes per axis of a stencil, and how far its first node may lie below the particle's cell.
  virtual int support() const = 0;
  /// Whether stencils that reach beyond a wall at rest are made to end there.
  virtual bool ends_at_walls() const = 0;
  /// First node of each particle's stencil, local numbering (for sorting).
  virtual void first_nodes(const ParticleStore& particles, const GridTopology<Dim>& grid,
                           std::vector<LocalIndex>& nodes) const = 0;

  /// P2G of mass, momentum and, where `with_force`, internal force. No state changes.
  virtual void prime(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                     NodeFields<Dim>& fields, bool with_force) const = 0;

  /// P2G of forces from outside (N), block by block, to a column; `force` says whether there is
  /// any.
  using BlockForce = std::function<bool(LocalIndex block, Lanes (&force)[Dim])>;
  virtual void outside_force(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                             const NodeColumn& column, const BlockForce& force) const = 0;

  /// P2G of what the fields' `surface` holds, of the blocks with a particle whose stencil's first
  /// node is marked. No state changes.
  virtual PassOutcome<Dim> surface(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                   NodeFields<Dim>& fields, std::span<const char> asked) const = 0;
  /// Of a node, by the distance of a particle along an axis; `size`: of the particle's location;
  /// both lengths in cells.
  virtual double weight_along(double distance, double size) const = 0;

  /// G2P of the residual velocity (NodeFields::refine), and its momentum back to the same nodes.
  /// No state changes.
  virtual PassOutcome<Dim> refine_velocity(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                           NodeFields<Dim>& fields) const = 0;

  /// P2G of the mass times the divergence of the gradient velocity, in the place of a re-mapped
  /// momentum's first component. No state changes.
  virtual PassOutcome<Dim> divergence(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                      NodeFields<Dim>& fields) const = 0;

  // MUSL, two passes.
  /// G2P of the velocity at the old place, and its momentum back to the same nodes.
  virtual PassOutcome<Dim> musl_velocity(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                         NodeFields<Dim>& fields) const = 0;
  /// Velocity gradient at the old place, stress, move; P2G of mass, momentum, force at the new.
  virtual PassOutcome<Dim> musl_stress(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                       NodeFields<Dim>& fields, double dt,
                                       const MoveBounds<Dim>& bounds) const = 0;
  /// The same, and the move is by the gradient velocity.
  virtual PassOutcome<Dim> musl_displacement(const BodyPart<Dim>& part,
                                             const GridTopology<Dim>& grid, NodeFields<Dim>& fields,
                                             double dt, const MoveBounds<Dim>& bounds) const = 0;
  // USF, two passes.
  /// Velocity gradient, stress, P2G of the force.
  virtual PassOutcome<Dim> usf_stress(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                      NodeFields<Dim>& fields, double dt) const = 0;
  /// G2P of the velocity, move; P2G of mass and momentum at the new place.
  virtual PassOutcome<Dim> usf_velocity(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                        NodeFields<Dim>& fields, double dt,
                                        const MoveBounds<Dim>& bounds) const = 0;
  // USAVG: stress and force as in USF by half a step, velocity as in MUSL, and:
  /// Velocity gradient at the old place, stress by half a step, move; P2G of mass and momentum at
  /// the new place.
  virtual PassOutcome<Dim> usavg_stress(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                                        NodeFields<Dim>& fields, double dt,
                                        const MoveBounds<Dim>& bounds) const = 0;
  // USL, one pass.
  virtual PassOutcome<Dim> usl(const BodyPart<Dim>& part, const GridTopology<Dim>& grid,
                               NodeFields<Dim>& fields, double dt,
                               const MoveBounds<Dim>& bounds) const = 0;
};

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(OneOf<ShapeRow> shape, OneOf<SchemeRow> scheme,
                                             const TransferOptions& options);

}  // namespace mpm
