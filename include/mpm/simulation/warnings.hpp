#pragma once
/// What a specialist would warn of before a run.

#include <mpm/simulation/layout.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Each with its remedy: thin or unconnected walls, speeds, a long run, particles out of the
/// piston's reach. The rules are in docs/troubleshooting.md. Collective; the same on every part.
template <int Dim>
std::vector<std::string> warnings_of(const scene::Scene& scene,
                                     const micrograph::Specimen<Dim>& specimen,
                                     const Layout<Dim>& layout, const micrograph::Share& share);

}  // namespace mpm
