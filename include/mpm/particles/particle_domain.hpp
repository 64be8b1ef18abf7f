#pragma once
/// The domains of particles, for the shape functions that have them carried along: half axes r_k,
/// m, component d of r_k in column d + Dim * k of `domain`.

#include <mpm/particles/particle_store.hpp>

#include <string_view>

namespace mpm {

inline constexpr std::string_view domain_column = "domain";

/// Gives a particle a box with these half sides, m, for its domain; nothing where particles have
/// none.
template <int Dim>
void set_domain_at_rest(ColumnGroup& motion, LocalIndex particle, const Vec<Dim>& half_size)
{
  const int first = motion.find(std::string(domain_column));
  if (first < 0) return;
  for (int d = 0; d < Dim; ++d) motion(first + d * (Dim + 1), particle) = half_size[d];
}

}  // namespace mpm
