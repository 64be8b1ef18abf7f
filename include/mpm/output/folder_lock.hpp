#pragma once
/// One run at a time in a folder of results.

#include <filesystem>

namespace mpm::output {

/// An advisory lock (flock) on FOLDER/in_use.lock, which names its holder. The system gives it back
/// however the process ends, so that a file that a killed run has left locks nothing. Where the
/// file system knows no locks, or the file cannot be made, nothing is locked.
class FolderLock {
 public:
  /// Throws InputError if another process has it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  void close();
  void remove_file() const;
  /// Whoever had it before may have taken the file away after it was opened here.
  bool bears_its_name() const;
  void name_holder() const;

  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace mpm::output
