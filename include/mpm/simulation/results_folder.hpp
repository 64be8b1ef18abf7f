#pragma once
/// The folder that a run leaves its results in.

#include <mpm/output/folder_lock.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// On one rank. From start_anew or go_on to its end no other run may write there.
class ResultsFolder {
 public:
  explicit ResultsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws InputError if one of `inputs` is a file that a run leaves, and takes away, and is not
  /// the effective scene itself.
  void expect_no_input(std::span<const std::filesystem::path> inputs,
                       const std::string& effective_scene) const;
  /// Throws InputError if the folder holds the results of a run, or one is writing there.
  void expect_no_run() const;
  /// Throws InputError if the folder holds the results of a run, and the checkpoint is none of it.
  void expect_same_run(const std::filesystem::path& checkpoint) const;

  /// Makes it if it is not there. What another run has left there is taken away if `overwrite`:
  /// history, summary, snapshots and their lists, checkpoints, the state at a failure, the report.
  /// Throws InputError if it is not, or if a run is writing there; FileError if something cannot be
  /// made or taken away.
  void start_anew(bool overwrite);
  /// Takes away what is true of a run only when it has ended. Throws InputError if a run is writing
  /// there.
  void go_on();

 private:
  void occupy();
  bool holds_a_run() const;
  /// All that a run leaves, as far as it is there.
  std::vector<std::filesystem::path> files() const;
  std::vector<std::filesystem::path> files_of_report() const;
  void remove(const std::filesystem::path& file) const;
  void clear_report() const;
  void clear() const;
  std::filesystem::path folder_;
  std::optional<output::FolderLock> lock_;
};

}  // namespace mpm
