#pragma once
/// A scene from first to last step.

#include <mpm/micrograph/specimen.hpp>
#include <mpm/scene/scene.hpp>
#include <mpm/simulation/model.hpp>

#include <filesystem>
#include <string>

namespace mpm {

/// What will run, what is left out, and what it will take: the text of --check.
std::string plan_text(const scene::Scene& scene, const micrograph::Specimen<2>& specimen,
                      const Layout& layout, const Decomposition<2>& decomposition);

/// How the scene would be shared out among each of these numbers of ranks: the text of
/// --check --ranks.
std::string rank_study_text(const scene::Scene& scene, const micrograph::Specimen<2>& specimen,
                            const Layout& layout, const std::vector<int>& ranks);

/// s, from the wave speed and the largest speed at the start.
double first_time_step(const Layout& layout);

/// Runs the scene; writes history.csv, summary.json, the effective scene, snapshots and the picture
/// of the specimen into `folder`. Collective. Throws on every rank or on none.
void run_scene(const scene::Scene& scene, const micrograph::Specimen<2>& specimen,
               const Layout& layout, const Decomposition<2>& decomposition,
               const std::filesystem::path& folder);

}  // namespace mpm
