#pragma once
/// How a scene names a stack whose slices are files.

#include <filesystem>
#include <string>

namespace mpm::scene {

/// Whether all files that fit are meant: there is a `*` in the file's name.
inline bool names_slices(const std::filesystem::path& file)
{
  return file.filename().string().find('*') != std::string::npos;
}

}  // namespace mpm::scene
