#pragma once
/// The ways a run can fail, each with its exit status, and the check of our own assumptions.

#include <mpm/core/types.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace mpm {

/// Exit status of the programs: the same on every rank.
enum class ExitStatus : int {
  done = 0,
  bad_input = 2,
  numerical_failure = 3,
  file_failure = 4,
  interrupted = 75  ///< EX_TEMPFAIL: to be started again
};

/// The user's input is wrong. Carries every problem found, one line each:
/// `file:line:column: key path is VALUE (why it is wrong). Remedy.`
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> problems);
  explicit InputError(const std::string& problem) : InputError(std::vector{problem}) {}
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

/// The computation left the range in which it means anything (NaN, a particle outside the grid).
class NumericalError : public std::runtime_error {
 public:
  static constexpr GlobalIndex none = -1;
  explicit NumericalError(const std::string& text, GlobalIndex particle = none)
      : std::runtime_error(text), particle_(particle)
  {
  }
  /// Id of the particle at which it showed, or `none`.
  GlobalIndex particle() const { return particle_; }

 private:
  GlobalIndex particle_;
};

/// Reading or writing a file failed for a reason that is not the scene's fault.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The run was asked to end before its end, and has left behind what it goes on from.
class Interruption : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace mpm

/// Our own mistakes, checked in Developer and Debug builds only.
#ifdef NDEBUG
#define MPM_ASSERT(condition) ((void)0)
#else
#define MPM_ASSERT(condition) \
  ((condition) ? (void)0 : ::mpm::assertion_failed(#condition, __FILE__, __LINE__))
#endif
