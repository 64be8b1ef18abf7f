#pragma once
/// What the keys of shapes have in common.

#include <mpm/scene/schema.hpp>

#include <fmt/format.h>

namespace mpm::scene {

inline const Traits coordinates{.quantity = Quantity::length, .need = Need::required};
inline const Traits extent{.quantity = Quantity::length, .bound = above(0), .need = Need::required};

/// Of a box in which `upper` is not beyond `lower` everywhere.
template <std::size_t Dim>
std::optional<Defect> box_defect(const std::array<double, Dim>& lower,
                                 const std::array<double, Dim>& upper, int dimensions)
{
  for (std::size_t d = 0; d < std::size_t(dimensions); ++d)
    if (!(lower[d] < upper[d]))
      return Defect{"upper", fmt::format("must be above lower along {}", "xyz"[d])};
  return std::nullopt;
}

}  // namespace mpm::scene
