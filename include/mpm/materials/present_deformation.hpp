#pragma once
/// What the particles of a body have come to: how fast waves run in them, and whether they still
/// are a solid.

#include <mpm/materials/body.hpp>

#include <optional>

namespace mpm {

/// Of J: how far a particle may be compressed or stretched until no law of a solid means anything.
/// A solid specimen at the largest strain that a scene may ask for, 99 %, is at the lower one.
inline constexpr double least_volume_ratio = 0.01, largest_volume_ratio = 100;

struct BeyondBounds {
  LocalIndex particle;
  double volume_ratio;
  bool operator==(const BeyondBounds&) const = default;
};

struct PresentDeformation {
  double wave_speed;  ///< m/s, of the fastest wave in the particles; at least the law's own
  /// The first particle whose J is beyond the bounds, or no number.
  std::optional<BeyondBounds> beyond_bounds;
};

/// One way through the state for both: it is read from memory, and that is what it costs.
template <int Dim>
PresentDeformation present_deformation(const Body<Dim>& body);

}  // namespace mpm
