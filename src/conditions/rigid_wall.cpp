#include <mpm/conditions/rigid_wall.hpp>

#include <cmath>
#include <limits>

namespace mpm {

namespace {

/// Of nodes, along an axis, m.
template <int Dim>
auto places_along(const MeshNodes<Dim>& nodes, int axis)
{
  return [along = nodes.along(axis)](LocalIndex node) {
    return along[std::ptrdiff_t(node) * MeshNodes<Dim>::stride];
  };
}

}  // namespace

template <int Dim>
RigidWall<Dim>::RigidWall(const WallPlacement& placement, const WallMotion& motion, WallGrip grip,
                          ReactionBook book)
    : BoundaryCondition<Dim>(book), placement_(placement), motion_(motion), grip_(grip)
{
}

template <int Dim>
void RigidWall<Dim>::find_nodes(const Nodes<Dim>& nodes, double time)
{
  const Found wanted{nodes.listing(), position(time)};
  if (found_for_ == wanted) return;
  found_for_ = wanted;
  // From the node nearest to the face on. Were it the first one behind the face, the last cell in
  // front would be squeezed as a full one however little of it is left: the stress of a block of 20
  // cells would be 18 % low at 10 % strain, and particles would end up behind the face.
  const int axis = placement_.axis;
  const double reach = (0.5 + 1e-9) * nodes.spacing()[axis];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Region<Dim> behind{Vec<Dim>::Constant(-infinity), Vec<Dim>::Constant(infinity)};
  if (placement_.upper)
    behind.lower[axis] = wanted.position - reach;
  else
    behind.upper[axis] = wanted.position + reach;
  nodes.find_within(behind, found_);
}

template <int Dim>
void RigidWall<Dim>::constrain_updated(const Nodes<Dim>& nodes, NodeFields<Dim>& fields,
                                       double time, double dt)
{
  const double before = motion_.velocity(time), after = motion_.velocity(time + dt);
  find_nodes(nodes, time + dt);
  for (const LocalIndex node : found_) {
    if (!fields.is_active(node)) continue;
    const bool owned = nodes.is_owned(node);
    for (int d = 0; d < Dim; ++d)
      if (d == placement_.axis)
        this->constrain(fields, node, owned, d, before, after);
      else if (grip_ == WallGrip::stick)
        this->constrain(fields, node, owned, d, 0, 0);
  }
}

template <int Dim>
void RigidWall<Dim>::constrain_gradient(const Nodes<Dim>& nodes, NodeFields<Dim>& fields,
                                        double time, double dt)
{
  const double velocity = motion_.velocity(time + dt);
  find_nodes(nodes, time + dt);
  for (const LocalIndex node : found_) {
    if (!fields.is_active(node)) continue;
    for (int d = 0; d < Dim; ++d)
      if (d == placement_.axis)
        fields.set_gradient_velocity(node, d, velocity);
      else if (grip_ == WallGrip::stick)
        fields.set_gradient_velocity(node, d, 0);
  }
}

template <int Dim>
void RigidWall<Dim>::find_near(const MeshNodes<Dim>& nodes, double face)
{
  const int axis = placement_.axis;
  const double reach = nodes.spacing()[axis], side = placement_.upper ? 1 : -1;
  if (near_ && nodes.way() >= near_->way &&
      nodes.way() - near_->way + std::abs(face - near_->face) < 0.5 * reach)
    return;
  near_ = Near{nodes.way(), face, {}, {}};
  const auto at = places_along(nodes, axis);
  for (LocalIndex node = 0; node < nodes.size(); ++node) {
    const bool held = grip_ != WallGrip::contact &&
                      std::abs(nodes.rest(node, axis) - placement_.position) < 1e-9 * reach;
    if (held)
      near_->held.push_back(node);
    else if (side * (at(node) - face) > -reach)
      near_->nodes.push_back(node);
  }
}

/// Nodes that stood at the face are held by a wall with a grip; all others meet it one-sidedly, and
/// end the step at the face.
template <int Dim>
void RigidWall<Dim>::stop(const MeshNodes<Dim>& nodes, NodeFields<Dim>& fields, double time,
                          double dt)
{
  const int axis = placement_.axis;
  const double face = position(time + dt), side = placement_.upper ? 1 : -1;
  find_near(nodes, face);
  const auto at = places_along(nodes, axis);
  const auto put_to_face = [&](LocalIndex node) {
    const bool owned = nodes.is_owned(node);
    for (int d = 0; d < Dim; ++d)
      if (d == axis)
        this->drive(fields, node, owned, d, (face - at(node)) / dt);
      else if (grip_ == WallGrip::stick)
        this->drive(fields, node, owned, d, 0);
  };
  for (const LocalIndex node : near_->held) put_to_face(node);
  for (const LocalIndex node : near_->nodes)
    if (side * (at(node) + dt * fields.updated_of(node)[axis] - face) > 0) put_to_face(node);
}

template class RigidWall<2>;
template class RigidWall<3>;

}  // namespace mpm
