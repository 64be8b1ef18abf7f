#pragma once
/// How far a particle may be compressed or stretched until no law of a solid means anything.

#include <mpm/materials/body.hpp>

#include <optional>

namespace mpm {

/// Of J. A solid specimen at the largest strain that a scene may ask for, 99 %, is at the lower
/// one.
inline constexpr double least_volume_ratio = 0.01, largest_volume_ratio = 100;

struct BeyondBounds {
  LocalIndex particle;
  double volume_ratio;
  bool operator==(const BeyondBounds&) const = default;
};

/// The first particle whose J is beyond the bounds, or no number.
template <int Dim>
std::optional<BeyondBounds> find_beyond_bounds(const Body<Dim>& body);

}  // namespace mpm
