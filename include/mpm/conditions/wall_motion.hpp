#pragma once
/// How fast something rigid moves along one axis, and how far it has got.

#include <vector>

namespace mpm {

/// Constant speed after an optional smooth start, V(t) = V (3 s^2 - 2 s^3), s = t / ramp_time; or a
/// table of velocities.
struct WallMotion {
  struct Entry {
    double time, velocity;  ///< s, m/s
    bool operator==(const Entry&) const = default;
  };

  double speed = 0;      ///< m/s along the axis, signed
  double ramp_time = 0;  ///< s
  /// In place of the two above where it is not empty: ascending times, straight lines between
  /// them, constant before the first and after the last.
  std::vector<Entry> table{};

  double velocity(double time) const;
  double displacement(double time) const;
  /// Largest size of the velocity at any time.
  double largest_speed() const;
  /// Time at which the displacement reaches `length` (same sign as the speed); without a table.
  double time_of(double length) const;
};

}  // namespace mpm
