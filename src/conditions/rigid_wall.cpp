#include <mpm/conditions/rigid_wall.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

double WallMotion::velocity(double time) const
{
  if (time >= ramp_time) return speed;
  const double s = std::max(0.0, time / ramp_time);
  return speed * s * s * (3 - 2 * s);
}

double WallMotion::displacement(double time) const
{
  if (time >= ramp_time) return speed * (time - 0.5 * ramp_time);
  const double s = std::max(0.0, time / ramp_time);
  return speed * ramp_time * s * s * s * (1 - 0.5 * s);
}

double WallMotion::time_of(double length) const
{
  const double time = length / speed + 0.5 * ramp_time;
  if (time >= ramp_time) return time;
  double lower = 0, upper = ramp_time;  // still in the smooth start: bisection
  while (upper - lower > 1e-15 * ramp_time) {
    const double middle = 0.5 * (lower + upper);
    (displacement(middle) / length < 1 ? lower : upper) = middle;
  }
  return upper;
}

template <int Dim>
RigidWall<Dim>::RigidWall(const Placement& placement, const WallMotion& motion, WallGrip grip,
                          ReactionBook book)
    : BoundaryCondition<Dim>(book), placement_(placement), motion_(motion), grip_(grip)
{
}

template <int Dim>
template <class Visit>
void RigidWall<Dim>::for_each_node(const NodeGrid<Dim>& grid, double time, Visit visit) const
{
  const int axis = placement_.axis;
  const double h = grid.geometry().spacing[axis];
  // From the node nearest to the face on. Were it the first one behind the face, the last cell in
  // front would be squeezed as a full one however little of it is left: the stress of a block of 20
  // cells would be 18 % low at 10 % strain, and particles would end up behind the face.
  const double index = (position(time) - grid.geometry().origin[axis]) / h;
  IndexBox<Dim> behind{grid.local()};
  if (placement_.upper)
    behind.lower[axis] = std::max(behind.lower[axis], LocalIndex(std::ceil(index - 0.5 - 1e-9)));
  else
    behind.upper[axis] =
        std::min(behind.upper[axis], LocalIndex(std::floor(index + 0.5 + 1e-9)) + 1);
  if (behind.empty()) return;
  for (const NodeRun<Dim>& run : grid.runs()) {
    bool row = true;
    for (int d = 1; d < Dim; ++d)
      row = row && run.start[d] >= behind.lower[d] && run.start[d] < behind.upper[d];
    if (!row) continue;
    const LocalIndex from = std::max(run.start[0], behind.lower[0]);
    const LocalIndex to = std::min(run.start[0] + run.length, behind.upper[0]);
    for (LocalIndex i = from; i < to; ++i) {
      const LocalIndex node = run.first + i - run.start[0];
      if (grid.is_active(node)) visit(node, grid.is_owned(node));
    }
  }
}

template <int Dim>
void RigidWall<Dim>::constrain_updated(NodeGrid<Dim>& grid, double time, double dt)
{
  const double before = motion_.velocity(time), after = motion_.velocity(time + dt);
  for_each_node(grid, time + dt, [&](LocalIndex node, bool owned) {
    for (int d = 0; d < Dim; ++d)
      if (d == placement_.axis)
        this->constrain(grid, node, owned, d, before, after);
      else if (grip_ == WallGrip::stick)
        this->constrain(grid, node, owned, d, 0, 0);
  });
}

template <int Dim>
void RigidWall<Dim>::constrain_gradient(NodeGrid<Dim>& grid, double time, double dt)
{
  const double velocity = motion_.velocity(time + dt);
  for_each_node(grid, time + dt, [&](LocalIndex node, bool) {
    for (int d = 0; d < Dim; ++d)
      if (d == placement_.axis)
        grid.set_gradient_velocity(node, d, velocity);
      else if (grip_ == WallGrip::stick)
        grid.set_gradient_velocity(node, d, 0);
  });
}

template class RigidWall<2>;
template class RigidWall<3>;

}  // namespace mpm
