#include <mpm/core/folded.hpp>
#include <mpm/core/terminal.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

namespace mpm {

bool is_terminal(int descriptor)
{
  if (!std::getenv("OMPI_COMM_WORLD_RANK") && !std::getenv("PMI_RANK"))
    return isatty(descriptor) != 0;
  std::error_code none;
  const auto target = std::filesystem::read_symlink(
      "/proc/" + std::to_string(getppid()) + "/fd/" + std::to_string(descriptor), none);
  return !none &&
         (target.string().starts_with("/dev/pts/") || target.string().starts_with("/dev/tty"));
}

void print_message(const std::string& text)
{
  std::fputs(((is_terminal(STDERR_FILENO) ? folded_message(text) : text) + "\n").c_str(), stderr);
}

}  // namespace mpm
