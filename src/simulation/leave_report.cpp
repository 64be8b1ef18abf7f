#include <mpm/simulation/leave_report.hpp>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mpm {

namespace {

/// As inherited, but for what tells a program that it is a rank: HDF5 with MPI would look for
/// others.
std::vector<char*> environment_of_no_rank()
{
  std::vector<char*> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    bool of_a_rank = false;
    for (const std::string_view start : {"OMPI_", "PMIX_", "PMI_", "PRTE_", "MPI_"})
      of_a_rank = of_a_rank || std::string_view(*entry).starts_with(start);
    if (!of_a_rank) kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
}

std::filesystem::path place_of_report_program()
{
  if (const char* named = std::getenv("MPM_REPORT")) return named;
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).replace_filename("mpm_report");
}

/// The program's exit status, or what kept it from having one.
int status_of(const std::vector<std::string>& words, std::string& failure)
{
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::vector<char*> environment = environment_of_no_rank();
  pid_t child = 0;
  if (const int error =
          posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environment.data());
      error != 0) {
    failure = std::generic_category().message(error);
    return -1;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  failure = fmt::format("ended by signal {}", WTERMSIG(status));
  return -1;
}

}  // namespace

void leave_report(const std::filesystem::path& results, const std::string& remark)
{
  const std::filesystem::path program = place_of_report_program();
  std::vector<std::string> words{program.string(), results.string()};
  if (!remark.empty()) words.insert(words.end(), {"--remark", remark});
  std::fflush(stdout);
  std::string failure;
  // With a status of its own it has said what was wrong.
  if (status_of(words, failure) >= 0) return;
  fmt::print(stderr,
             "no report: {}: {}.\nMake it with the mpm_report of the build:\n"
             "  mpm_report {}\n",
             program.string(), failure, results.string());
}

}  // namespace mpm
