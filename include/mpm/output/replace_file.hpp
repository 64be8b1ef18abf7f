#pragma once
/// Files that are there whole or not at all: written under a temporary name, synced, renamed.

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace mpm::output {

/// The name a file has until it is complete: beside it, so that the rename stays on one file
/// system.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Renames a file, over one of that name. Throws FileError.
void give_name(const std::filesystem::path& from, const std::filesystem::path& file);

/// Syncs the temporary file, renames it and syncs the directory. Throws FileError.
void rename_when_synced(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// Replaces FILE by TEXT; after a failure the old file is as it was. Throws FileError.
void replace_file(const std::filesystem::path& file, std::string_view text);

/// Makes the file if it is not there and claims that many bytes of the disk for it; its size may
/// grow up to that. Does nothing on a file system that cannot. Throws FileError, and removes the
/// file, if there is no room.
void reserve_room(const std::filesystem::path& file, std::int64_t bytes);

/// Like std::filesystem::create_directories. Throws FileError.
void make_directory(const std::filesystem::path& directory);

}  // namespace mpm::output
