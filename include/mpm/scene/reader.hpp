#pragma once
/// From a scene file to a checked Scene, and back.

#include <mpm/scene/scene.hpp>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace mpm::scene {

/// `overrides`: `path.to.key=value`, applied before anything is checked.
/// Throws InputError with every problem of the file, FileError without the table of units.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The scene with every default filled in: a file that read_scene turns back into the same Scene.
void write_effective_scene(std::ostream& out, const Scene& scene);

/// The page docs/input_reference.md.
void write_input_reference(std::ostream& out);

/// docs/scene.schema.json, for editors.
void write_input_schema(std::ostream& out);

}  // namespace mpm::scene
