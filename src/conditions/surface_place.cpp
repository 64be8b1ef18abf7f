#include <mpm/conditions/surface_place.hpp>

#include <algorithm>

namespace mpm {

namespace {

/// Cells beyond which no shape function reaches.
constexpr double reach = 3;
constexpr int places_per_cell = 64;

}  // namespace

SurfacePlace::SurfacePlace(const std::function<double(double)>& weight, double size)
    : first_(-reach), step_(1.0 / places_per_cell)
{
  for (int k = 0; k <= 2 * places_per_cell * int(reach); ++k) {
    const double surface = -reach + k * step_;
    double mass = 0, moment = 0;
    for (double x = surface - 0.5 * size; x > -reach; x -= size) {
      mass += weight(x);
      moment += weight(x) * x;
    }
    // What the node feels only just, or not at all, is as far away as its nearest particle.
    constexpr double nothing = 1e-9;
    means_.push_back(mass > nothing ? moment / mass : surface - 0.5 * size);
  }
  for (std::size_t k = 1; k < means_.size(); ++k) means_[k] = std::max(means_[k], means_[k - 1]);
}

double SurfacePlace::from_mean(double mean) const
{
  const auto above = std::ranges::upper_bound(means_, mean);
  if (above == means_.begin()) return first_;
  // Deep inside, where nothing tells surfaces apart, the nearest of them.
  if (above == means_.end()) {
    const auto last = std::ranges::lower_bound(means_, means_.back());
    return first_ + step_ * double(last - means_.begin());
  }
  const double low = *(above - 1), high = *above;
  return first_ + step_ * (double(above - 1 - means_.begin()) + (mean - low) / (high - low));
}

}  // namespace mpm
