#pragma once
/// What a specialist would warn of after a run.

#include <mpm/simulation/layout.hpp>
#include <mpm/simulation/run_result.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Each with its remedy: cells that failed, an energy balance that is open, ends of the specimen
/// that feel different stresses. The rules are in docs/troubleshooting.md. `result` holds its lines
/// and particles, and the largest energy error.
template <int Dim>
std::vector<std::string> warnings_of_result(const scene::Scene& scene, const Layout<Dim>& layout,
                                            const RunResult& result);

}  // namespace mpm
