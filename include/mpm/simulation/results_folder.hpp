#pragma once
/// The folder that a run leaves its results in.

#include <mpm/output/folder_lock.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace mpm {

/// On one rank. From start_anew or go_on to its end no other run may write there.
class ResultsFolder {
 public:
  explicit ResultsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Makes it if it is not there. What another run has left there is taken away if `overwrite`:
  /// history, summary, snapshots and their lists, checkpoints, the state at a failure, the report.
  /// Throws InputError if it is not, if a run is writing there, or if one of `inputs` stands where
  /// a result is to be written and is not the effective scene itself; FileError if something cannot
  /// be made or taken away.
  void start_anew(std::span<const std::filesystem::path> inputs, const std::string& effective_scene,
                  bool overwrite);
  /// Takes away what is true of a run only when it has ended. Throws InputError if a run is writing
  /// there.
  void go_on();

 private:
  void occupy();
  bool holds_a_run() const;
  void remove(const std::filesystem::path& file) const;
  void clear_report() const;
  void clear() const;
  std::filesystem::path folder_;
  std::optional<output::FolderLock> lock_;
};

}  // namespace mpm
