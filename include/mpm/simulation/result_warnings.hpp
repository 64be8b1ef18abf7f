#pragma once
/// What a specialist would warn of after a run.

#include <mpm/scene/scene.hpp>
#include <mpm/simulation/run_result.hpp>

#include <string>
#include <vector>

namespace mpm {

/// Each with its remedy: cells that failed, an energy balance that is open, ends of the specimen
/// that feel different stresses. The rules are in docs/troubleshooting.md. `wave_speed`: of the
/// fastest wave, m/s; of `result` its lines and particles.
std::vector<std::string> warnings_of_result(const scene::Scene& scene, double wave_speed,
                                            const RunResult& result);

}  // namespace mpm
