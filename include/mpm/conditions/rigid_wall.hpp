#pragma once
#include <mpm/conditions/boundary_condition.hpp>
#include <mpm/conditions/wall_motion.hpp>

#include <optional>
#include <vector>

namespace mpm {

enum class WallGrip {
  stick,   ///< all components follow the wall
  slip,    ///< the normal one only: also a plane of symmetry
  contact  ///< none: the wall pushes what comes to its face
};

struct WallPlacement {
  int axis;
  bool upper;       ///< the body lies below the face (wall at the upper end of the axis)
  double position;  ///< m, of the face at time 0
};

/// How a wall pushes particles: each stores kappa C V0 (d / s)^2 / 2, where its face is d behind
/// the wall's, C is the modulus of the fastest wave and s the size of a location along the axis.
template <int Dim>
struct WallStiffness {
  double kappa = 0;
  Vec<Dim> location_size = Vec<Dim>::Ones();  ///< m
};

/// A plane normal to an axis with a rigid half space behind it: the node nearest to the face and
/// every node behind it move with the wall; or, with the grip of contact, the wall pushes particles
/// whose faces come behind its own. Fixed edge, lateral wall and piston are this.
template <int Dim>
class RigidWall final : public BoundaryCondition<Dim> {
 public:
  /// `stiffness`: of a wall that pushes; `friction`: Coulomb's coefficient of one that stops nodes
  /// and holds none.
  RigidWall(const WallPlacement& placement, const WallMotion& motion, WallGrip grip,
            ReactionBook book, const WallStiffness<Dim>& stiffness = {}, double friction = 0);

  void constrain_updated(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                         double dt) override;
  void constrain_gradient(const Nodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                          double dt) override;

  void stop(const MeshNodes<Dim>& nodes, NodeFields<Dim>& fields, double time, double dt) override;

  bool rubs() const override { return friction_ > 0; }
  double friction_work() const override { return friction_work_; }

  bool pushes() const override { return grip_ == WallGrip::contact; }
  bool push(const Body<Dim>& body, LocalIndex block, double time, Lanes (&force)[Dim]) override;
  void book_push(double time, double dt) override;
  void reset_push() override { push_ = 0; }
  ContactSums stored(const Body<Dim>& body, double time) const override;
  void archive(Archive& archive) override;

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
  /// How far the faces of a block's particles are behind that of the wall, m; 0 in front of it.
  Lanes depth_of(const double* motion, double time) const;
  /// N/(kg m): of the push on a particle, over its mass and depth.
  double push_per_mass(const Body<Dim>& body) const;

  WallPlacement placement_;
  WallMotion motion_;
  WallGrip grip_;
  WallStiffness<Dim> stiffness_;
  double friction_;
  double push_ = 0;           ///< N along the axis, on this rank's particles
  double friction_work_ = 0;  ///< J, of this rank's nodes
  std::optional<Found> found_for_;
  std::vector<LocalIndex> found_;  ///< nodes at the face and behind it
  void find_near(const MeshNodes<Dim>& nodes, double face);
  void rub(NodeFields<Dim>& fields, LocalIndex node, bool owned, double taken);

  /// Of nodes that move with a body: those that stood at the face at time 0, and all that may come
  /// to it before the face and they have gone half a location.
  struct Near {
    GlobalIndex mesh;  ///< whose nodes they are
    double way, face;  ///< m, when they were found
    std::vector<LocalIndex> held, nodes;
  };
  std::optional<Near> near_;
};

}  // namespace mpm
