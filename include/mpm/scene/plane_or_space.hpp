#pragma once
/// Values of a scene that come one per axis or side: fewer in the plane than in space.

#include <array>
#include <cstddef>

namespace mpm::scene {

/// A scene in the plane has the first `InPlane` entries and leaves the others as they are by
/// default; a scene in space has all of them.
template <class T, std::size_t InPlane, std::size_t InSpace>
struct PlaneOrSpace : std::array<T, InSpace> {
  static constexpr std::size_t count(int dimensions) { return dimensions == 2 ? InPlane : InSpace; }
};

/// x, y; in space z.
template <class T>
using PerAxis = PlaneOrSpace<T, 2, 3>;
/// Left, right, bottom, top; in space back (lower z), front (upper z). Side s is the lower (s even)
/// or upper one of axis s / 2.
template <class T>
using PerSide = PlaneOrSpace<T, 4, 6>;
/// Lower and upper side of each axis but the piston's, axes ascending.
template <class T>
using PerLateralSide = PlaneOrSpace<T, 2, 4>;

/// A place, m.
template <int Dim>
using Point = std::array<double, std::size_t(Dim)>;

}  // namespace mpm::scene
