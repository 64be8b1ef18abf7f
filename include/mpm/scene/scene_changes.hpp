#pragma once
/// What is different between two scenes.

#include <string>
#include <vector>

namespace mpm::scene {

/// Of effective scenes as YAML: a line `path was A and is B` for each value that may not change
/// when a run goes on. The end (loading.strain, free_motion.end_time, steps), `output`,
/// numerics.cfl, numerics.recovery and the texts may. Throws InputError if `before` is no scene.
std::vector<std::string> changes_that_matter(const std::string& before, const std::string& now);

}  // namespace mpm::scene
