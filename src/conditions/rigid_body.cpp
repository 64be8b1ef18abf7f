#include <mpm/conditions/rigid_body.hpp>
#include <mpm/core/index_box.hpp>

#include <cmath>
#include <limits>

namespace mpm {

namespace {

/// Of a cell: nodes so near to a face are on it.
constexpr double on_the_face = 1e-9;

}  // namespace

template <int Dim>
RigidBody<Dim>::RigidBody(const std::vector<Vec<Dim>>& points, const Vec<Dim>& half_size,
                          const std::array<WallMotion, Dim>& motion, ReactionBook book)
    : BoundaryCondition<Dim>(book), half_size_(half_size), motion_(motion)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  bounds_ = {Vec<Dim>::Constant(infinity), Vec<Dim>::Constant(-infinity)};
  for (const Vec<Dim>& point : points) {
    buckets_[key_of(bucket_of(point))].push_back(point);
    bounds_.lower = bounds_.lower.cwiseMin(point - half_size);
    bounds_.upper = bounds_.upper.cwiseMax(point + half_size);
  }
}

template <int Dim>
IndexVec<Dim> RigidBody<Dim>::bucket_of(const Vec<Dim>& place) const
{
  IndexVec<Dim> bucket;
  for (int d = 0; d < Dim; ++d) bucket[d] = LocalIndex(std::floor(place[d] / (2 * half_size_[d])));
  return bucket;
}

template <int Dim>
GlobalIndex RigidBody<Dim>::key_of(const IndexVec<Dim>& bucket)
{
  constexpr GlobalIndex most = 1 << 21;  // per axis; a clash costs time, not correctness
  GlobalIndex key = 0;
  for (int d = 0; d < Dim; ++d) key = key * most + bucket[d];
  return key;
}

template <int Dim>
bool RigidBody<Dim>::holds(const Vec<Dim>& place, const Vec<Dim>& tolerance) const
{
  bool found = false;
  const IndexVec<Dim> middle = bucket_of(place);
  for_each_index(IndexBox<Dim>{(middle.array() - 1).matrix(), (middle.array() + 2).matrix()},
                 [&](const IndexVec<Dim>& bucket) {
                   if (found) return;
                   const auto points = buckets_.find(key_of(bucket));
                   if (points == buckets_.end()) return;
                   for (const Vec<Dim>& point : points->second)
                     found =
                         found ||
                         ((place - point).array().abs() <= (half_size_ + tolerance).array()).all();
                 });
  return found;
}

template <int Dim>
bool RigidBody<Dim>::holds_image(const Vec<Dim>& place, const Vec<Dim>& period,
                                 const Vec<Dim>& tolerance) const
{
  // One as near as can be to the middle, and those beside it: a body as wide as a period holds
  // places at the seam from both of its sides.
  Vec<Dim> nearest = place;
  IndexBox<Dim> images{IndexVec<Dim>::Zero(), IndexVec<Dim>::Ones()};
  for (int d = 0; d < Dim; ++d) {
    if (period[d] <= 0) continue;
    const double middle = 0.5 * (bounds_.lower[d] + bounds_.upper[d]);
    nearest[d] -= period[d] * std::round((place[d] - middle) / period[d]);
    images.lower[d] = -1;
    images.upper[d] = 2;
  }
  bool found = false;
  for_each_index(images, [&](const IndexVec<Dim>& image) {
    if (found) return;
    const Vec<Dim> there = nearest + image.template cast<double>().cwiseProduct(period);
    if ((there.array() < (bounds_.lower - tolerance).array()).any() ||
        (there.array() > (bounds_.upper + tolerance).array()).any())
      return;
    found = holds(there, tolerance);
  });
  return found;
}

template <int Dim>
void RigidBody<Dim>::find_nodes(const Nodes<Dim>& nodes, double time)
{
  const Vec<Dim> tolerance = on_the_face * nodes.spacing(), period = nodes.period();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec<Dim> moved;
  for (int d = 0; d < Dim; ++d) moved[d] = motion_[d].displacement(time);
  if (found_for_ && found_for_->listing == nodes.listing() && found_for_->moved == moved) return;
  found_for_ = Found{nodes.listing(), moved};
  Region<Dim> region;
  for (int d = 0; d < Dim; ++d) {
    const bool anywhere = period[d] > 0;  // its images may lie across the seam
    region.lower[d] = anywhere ? -infinity : bounds_.lower[d] + moved[d] - tolerance[d];
    region.upper[d] = anywhere ? infinity : bounds_.upper[d] + moved[d] + tolerance[d];
  }
  nodes.find_within(region, near_);
  found_.clear();
  for (const LocalIndex node : near_)
    if (holds_image(nodes.position(node) - moved, period, tolerance)) found_.push_back(node);
}

template <int Dim>
void RigidBody<Dim>::constrain_updated(const Nodes<Dim>& nodes, NodeFields<Dim>& fields,
                                       double time, double dt)
{
  find_nodes(nodes, time + dt);
  for (const LocalIndex node : found_) {
    if (!fields.is_active(node)) continue;
    for (int d = 0; d < Dim; ++d)
      this->constrain(fields, node, nodes.is_owned(node), d, motion_[d].velocity(time),
                      motion_[d].velocity(time + dt));
  }
}

template <int Dim>
void RigidBody<Dim>::constrain_gradient(const Nodes<Dim>& nodes, NodeFields<Dim>& fields,
                                        double time, double dt)
{
  find_nodes(nodes, time + dt);
  for (const LocalIndex node : found_) {
    if (!fields.is_active(node)) continue;
    for (int d = 0; d < Dim; ++d)
      fields.set_gradient_velocity(node, d, motion_[d].velocity(time + dt));
  }
}

template class RigidBody<2>;
template class RigidBody<3>;

}  // namespace mpm
