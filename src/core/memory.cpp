#include <mpm/core/memory.hpp>

#include <algorithm>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace mpm {

namespace {

/// Of a file that holds a number, or `max` (control groups of version 2).
double limit_in(const char* file)
{
  double bytes = 0;
  return std::ifstream(file) >> bytes ? bytes : std::numeric_limits<double>::infinity();
}

}  // namespace

double memory_limit()
{
  double least = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  least = std::min(least, limit_in("/sys/fs/cgroup/memory.max"));
  rlimit own{};
  if (getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
    least = std::min(least, double(own.rlim_cur));
  return least;
}

std::string memory_text(double bytes)
{
  if (bytes < 1e6) return fmt::format("{:.0f} kB", 1e-3 * bytes);
  if (bytes < 1e7) return fmt::format("{:.1f} MB", 1e-6 * bytes);
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                     : fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace mpm
