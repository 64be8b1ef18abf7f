#pragma once
#include <mpm/conditions/boundary_condition.hpp>

namespace mpm {

/// Constant speed after an optional smooth start: V(t) = V (3 s^2 - 2 s^3), s = t / ramp_time.
struct WallMotion {
  double speed = 0;      ///< m/s along the axis, signed
  double ramp_time = 0;  ///< s

  double velocity(double time) const;
  double displacement(double time) const;
  /// Time at which the displacement reaches `length` (same sign as the speed).
  double time_of(double length) const;
};

enum class WallGrip {
  stick,  ///< all components follow the wall
  slip    ///< the normal one only: also a plane of symmetry
};

/// A plane normal to an axis with a rigid half space behind it: the node nearest to the face and
/// every node behind it move with the wall. Fixed edge, lateral wall and piston are this.
template <int Dim>
class RigidWall final : public BoundaryCondition<Dim> {
 public:
  struct Placement {
    int axis;
    bool upper;       ///< the body lies below the face (wall at the upper end of the axis)
    double position;  ///< m, of the face at time 0
  };

  RigidWall(const Placement& placement, const WallMotion& motion, WallGrip grip, ReactionBook book);

  void constrain_updated(NodeGrid<Dim>& grid, double time, double dt) override;
  void constrain_gradient(NodeGrid<Dim>& grid, double time, double dt) override;

  const Placement& placement() const { return placement_; }
  const WallMotion& motion() const { return motion_; }
  /// m, of the face.
  double position(double time) const { return placement_.position + motion_.displacement(time); }
  /// How far a particle is behind the face, m (negative: in front).
  double depth(double coordinate, double time) const
  {
    const double d = coordinate - position(time);
    return placement_.upper ? d : -d;
  }

 private:
  template <class Visit>
  void for_each_node(const NodeGrid<Dim>& grid, double time, Visit visit) const;

  Placement placement_;
  WallMotion motion_;
  WallGrip grip_;
};

}  // namespace mpm
