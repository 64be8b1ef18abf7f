#pragma once
/// What a specialist would warn of before a run.

#include <mpm/simulation/layout.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Speed of the piston over that of the fastest wave, up to which both ends of shipped woods feel
/// the same stress within some percent.
inline constexpr double quasi_static_speed = 0.01;

/// Each with its remedy: thin or unconnected walls, speeds, a long run, particles out of the
/// piston's reach. The rules are in docs/troubleshooting.md. Collective; the same on every part.
template <int Dim>
std::vector<std::string> warnings_of(const scene::Scene& scene,
                                     const micrograph::Specimen<Dim>& specimen,
                                     const Layout<Dim>& layout, const micrograph::Share& share);

}  // namespace mpm
