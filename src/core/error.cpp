#include <mpm/core/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace mpm {

namespace {
std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines) {
    if (!text.empty()) text += '\n';
    text += line;
  }
  return text;
}
}  // namespace

InputError::InputError(std::vector<std::string> problems)
    : std::runtime_error(joined(problems)), problems_(std::move(problems))
{
}

void assertion_failed(const char* condition, const char* file, int line)
{
  std::fprintf(stderr, "%s:%d: internal error: %s does not hold\n", file, line, condition);
  std::abort();
}

}  // namespace mpm
