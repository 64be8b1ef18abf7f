#pragma once
/// Whether machine, launcher, libraries and this program work together: what a user asks first on a
/// new cluster.

#include <mpm/parallel/launcher.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace mpm {

/// Ends the process with status 1 and words on what it waited for, where a check does not end:
/// ranks that cannot reach each other wait for ever. One at a time.
class SelfTestLimit {
 public:
  SelfTestLimit(int seconds, const std::string& what);
  ~SelfTestLimit();
  SelfTestLimit(const SelfTestLimit&) = delete;
  SelfTestLimit& operator=(const SelfTestLimit&) = delete;
  /// So long again, for this.
  void begin(const std::string& what);

 private:
  int seconds_;
};

struct SelfTestRequest {
  std::filesystem::path folder;      ///< in which files are tried out
  bool quiet = false;                ///< what fails alone on the terminal
  std::optional<Launched> launched;  ///< by whom
};

/// Prints a line a check on rank 0. Collective; whether all have passed.
bool self_test(MPI_Comm comm, const SelfTestRequest& request, SelfTestLimit& limit);

}  // namespace mpm
