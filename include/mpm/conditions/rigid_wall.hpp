#pragma once
#include <mpm/conditions/boundary_condition.hpp>
#include <mpm/conditions/wall_motion.hpp>

#include <optional>
#include <vector>

namespace mpm {

enum class WallGrip {
  stick,   ///< all components follow the wall
  slip,    ///< the normal one only: also a plane of symmetry
  contact  ///< the normal one, while the wall is pushed
};

struct WallPlacement {
  int axis;
  bool upper;       ///< the body lies below the face (wall at the upper end of the axis)
  double position;  ///< m, of the face at time 0
};

/// A plane normal to an axis with a rigid half space behind it: the node nearest to the face and
/// every node behind it move with the wall. Fixed edge, lateral wall and piston are this.
template <int Dim>
class RigidWall final : public BoundaryCondition<Dim> {
 public:
  RigidWall(const WallPlacement& placement, const WallMotion& motion, WallGrip grip,
            ReactionBook book);

  void constrain_updated(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                         double dt) override;
  void constrain_gradient(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                          double dt) override;

  void stop(const MeshNodes<Dim>& nodes, NodeFields<Dim>& fields, double time, double dt) override;

  const WallPlacement& placement() const { return placement_; }
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
  /// What the nodes that were found last depend on.
  struct Found {
    GlobalIndex listing;
    double position;  ///< m, of the face
    bool operator==(const Found&) const = default;
  };
  void find_nodes(const Nodes<Dim>& nodes, double time);

  WallPlacement placement_;
  WallMotion motion_;
  WallGrip grip_;
  std::optional<Found> found_for_;
  std::vector<LocalIndex> found_;  ///< nodes at the face and behind it
  void find_near(const MeshNodes<Dim>& nodes, double face);

  /// Of nodes that move with a body: those that stood at the face at time 0, and all that may come
  /// to it before the face and they have gone half a location.
  struct Near {
    double way, face;  ///< m, when they were found
    std::vector<LocalIndex> held, nodes;
  };
  std::optional<Near> near_;
};

}  // namespace mpm
