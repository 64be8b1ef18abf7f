#pragma once
/// The checks of the self-test. Each is collective, returns what it has found, in a few words, and
/// throws std::runtime_error on every rank for what is wrong, with a remedy.

#include <mpm/parallel/launcher.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace mpm {

/// A folder in another one, for the life of the object; rank 0 makes it and takes it away. Throws
/// FileError on every rank.
class SelfTestFolder {
 public:
  SelfTestFolder(MPI_Comm comm, const std::filesystem::path& within);
  ~SelfTestFolder();
  SelfTestFolder(const SelfTestFolder&) = delete;
  SelfTestFolder& operator=(const SelfTestFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  MPI_Comm comm_;
  std::filesystem::path path_;
  std::filesystem::path made_;  ///< the uppermost folder that was not there; empty if none
};

std::string check_world(MPI_Comm comm, const std::optional<Launched>& launched);
std::string check_cores(MPI_Comm comm);
std::string check_messages(MPI_Comm comm);
std::string check_shared_folder(MPI_Comm comm, const std::filesystem::path& folder);
std::string check_parallel_file(MPI_Comm comm, const std::filesystem::path& folder);

/// Runs of a small scene, which leave their checkpoints in the folder.
std::string check_one_rank_agrees(MPI_Comm comm, const std::filesystem::path& folder,
                                  const char* formulation);
std::string check_checkpoint(MPI_Comm comm, const std::filesystem::path& folder);
std::string check_speed(MPI_Comm comm, const std::filesystem::path& folder);

}  // namespace mpm
