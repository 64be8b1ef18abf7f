#include <mpm/conditions/rigid_wall.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

template <int Dim>
RigidWall<Dim>::RigidWall(const WallPlacement& placement, const WallMotion& motion, WallGrip grip,
                          ReactionBook book, const WallStiffness<Dim>& stiffness, double friction)
    : BoundaryCondition<Dim>(book),
      placement_(placement),
      motion_(motion),
      grip_(grip),
      stiffness_(stiffness),
      friction_(friction)
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
  if (pushes()) return;
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
  if (pushes()) return;
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
  if (near_ && near_->mesh == nodes.mesh() && nodes.way() >= near_->way &&
      nodes.way() - near_->way + std::abs(face - near_->face) < 0.5 * reach)
    return;
  near_ = Near{nodes.mesh(), nodes.way(), face, {}, {}};
  for (LocalIndex node = 0; node < nodes.size(); ++node) {
    if (nodes.is_led(node)) continue;
    const bool held = grip_ != WallGrip::contact &&
                      std::abs(nodes.rest(node, axis) - placement_.position) < 1e-9 * reach;
    if (held)
      near_->held.push_back(node);
    else if (side * (nodes.place_of(node)[axis] - face) > -reach)
      near_->nodes.push_back(node);
  }
}

/// Coulomb: of its momentum along the face a node loses what it lost across it, `taken` (m/s) over
/// its mass, times the coefficient; all of it at most.
template <int Dim>
void RigidWall<Dim>::rub(NodeFields<Dim>& fields, LocalIndex node, bool owned, double taken)
{
  const double* u = fields.updated_of(node);
  double squared = 0;
  for (int d = 0; d < Dim; ++d)
    if (d != placement_.axis) squared += u[d] * u[d];
  if (!(squared > 0)) return;
  const double kept = std::max(0.0, 1 - friction_ * taken / std::sqrt(squared));
  for (int d = 0; d < Dim; ++d)
    if (d != placement_.axis) friction_work_ -= this->drive(fields, node, owned, d, kept * u[d]);
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
  const auto put_to_face = [&](LocalIndex node) {
    const bool owned = nodes.is_owned(node);
    for (int d = 0; d < Dim; ++d)
      if (d == axis)
        this->drive(fields, node, owned, d, (face - nodes.place_of(node)[axis]) / dt);
      else if (grip_ == WallGrip::stick)
        this->drive(fields, node, owned, d, 0);
  };
  for (const LocalIndex node : near_->held) put_to_face(node);
  for (const LocalIndex node : near_->nodes) {
    const double beyond =
        side * (nodes.place_of(node)[axis] + dt * fields.updated_of(node)[axis] - face);
    if (!(beyond > 0)) continue;
    put_to_face(node);
    if (friction_ > 0) rub(fields, node, nodes.is_owned(node), beyond / dt);
  }
}

template <int Dim>
Lanes RigidWall<Dim>::depth_of(const double* motion, double time) const
{
  const int axis = placement_.axis;
  const double side = placement_.upper ? 1 : -1;
  const Lanes centre = load(motion + (LeadingColumns<Dim>::position + axis) * lane_count);
  return stdx::max(side * (centre - position(time)) + 0.5 * stiffness_.location_size[axis],
                   Lanes(0.0));
}

template <int Dim>
double RigidWall<Dim>::push_per_mass(const Body<Dim>& body) const
{
  const double rate = body.law->wave_speed() / stiffness_.location_size[placement_.axis];
  return stiffness_.kappa * rate * rate;  // C = rho c^2
}

template <int Dim>
bool RigidWall<Dim>::push(const Body<Dim>& body, LocalIndex block, double time, Lanes (&force)[Dim])
{
  const double* motion = body.particles.motion().block(block);
  const Lanes depth = depth_of(motion, time);
  if (!stdx::any_of(depth > 0.0)) return false;
  const Lanes mass = load(motion + LeadingColumns<Dim>::mass * lane_count);
  const double towards = placement_.upper ? -1 : 1;
  const Lanes on_particles = towards * push_per_mass(body) * mass * depth;
  force[placement_.axis] += on_particles;
  push_ += stdx::reduce(on_particles);
  return true;
}

template <int Dim>
void RigidWall<Dim>::book_push(double time, double dt)
{
  this->book_force(placement_.axis, push_, motion_.velocity(time), dt);
}

template <int Dim>
ContactSums RigidWall<Dim>::stored(const Body<Dim>& body, double time) const
{
  ContactSums sums;
  Lanes energy = 0, way = 0, deepest = 0;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
    const double* motion = body.particles.motion().block(b);
    const Lanes mass = load(motion + LeadingColumns<Dim>::mass * lane_count);
    Lanes depth = depth_of(motion, time);
    stdx::where(mass <= 0.0, depth) = 0.0;
    energy += 0.5 * push_per_mass(body) * mass * depth * depth;
    way += depth;
    deepest = stdx::max(deepest, depth);
    sums.pairs += stdx::popcount(depth > 0.0);
  }
  sums.energy = stdx::reduce(energy);
  const double thickness = stiffness_.location_size[placement_.axis];
  sums.overlapped_area = stdx::reduce(way) * stiffness_.location_size.prod() / thickness;
  sums.deepest_overlap = stdx::hmax(deepest) / thickness;
  return sums;
}

template <int Dim>
void RigidWall<Dim>::archive(Archive& archive)
{
  this->archive_reaction(archive);
  if (pushes()) archive.value("push", push_, Over::sum);
  if (rubs()) archive.value("friction_work", friction_work_, Over::sum);
}

template class RigidWall<2>;
template class RigidWall<3>;

}  // namespace mpm
