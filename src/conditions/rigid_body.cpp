#include <mpm/conditions/rigid_body.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

template <int Dim>
RigidBody<Dim>::RigidBody(std::vector<Vec<Dim>> points, const Vec<Dim>& half_size,
                          const Vec<Dim>& velocity, ReactionBook book)
    : BoundaryCondition<Dim>(book),
      points_(std::move(points)),
      half_size_(half_size),
      velocity_(velocity)
{
}

template <int Dim>
void RigidBody<Dim>::mark_nodes(const NodeGrid<Dim>& grid, double time)
{
  nodes_.clear();
  const GridGeometry<Dim>& geometry = grid.geometry();
  for (const Vec<Dim>& point : points_) {
    IndexBox<Dim> inside;
    for (int d = 0; d < Dim; ++d) {
      const double centre = point[d] + velocity_[d] * time - geometry.origin[d];
      const double h = geometry.spacing[d];
      inside.lower[d] = LocalIndex(std::ceil((centre - half_size_[d]) / h - 1e-9));
      inside.upper[d] = LocalIndex(std::floor((centre + half_size_[d]) / h + 1e-9)) + 1;
    }
    inside = intersection(inside, grid.local());
    if (inside.empty()) continue;
    IndexVec<Dim> at = inside.lower;
    for (GlobalIndex k = 0; k < inside.size(); ++k) {
      GlobalIndex rest = k;
      for (int d = 0; d < Dim; ++d) {
        at[d] = inside.lower[d] + LocalIndex(rest % inside.count()[d]);
        rest /= inside.count()[d];
      }
      if (grid.is_active(grid.index_of(at))) nodes_.push_back(grid.index_of(at));
    }
  }
  std::ranges::sort(nodes_);
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

template <int Dim>
void RigidBody<Dim>::constrain_updated(NodeGrid<Dim>& grid, double time, double dt)
{
  mark_nodes(grid, time + dt);
  for (const LocalIndex node : nodes_)
    for (int d = 0; d < Dim; ++d)
      this->constrain(grid, node, grid.is_owned(node), d, velocity_[d], velocity_[d]);
}

template <int Dim>
void RigidBody<Dim>::constrain_gradient(NodeGrid<Dim>& grid, double time, double dt)
{
  mark_nodes(grid, time + dt);
  for (const LocalIndex node : nodes_)
    for (int d = 0; d < Dim; ++d) grid.set_gradient_velocity(node, d, velocity_[d]);
}

template class RigidBody<2>;
template class RigidBody<3>;

}  // namespace mpm
