#include <mpm/core/folded.hpp>

#include <algorithm>

namespace mpm {

namespace {
constexpr std::size_t width = 80;
}

std::string folded(const std::string& text, std::size_t indent)
{
  std::string result;
  std::size_t column = indent;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (column > indent && column + 1 + (end - at) > width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += text.substr(at, end - at);
    column += end - at;
    at = end + 1;
  }
  return result;
}

std::string folded_message(const std::string& text)
{
  std::string result;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    if (at > 0) result += '\n';
    result += line.size() <= width
                  ? line
                  : std::string(blanks, ' ') + folded(line.substr(blanks), blanks + 4);
    at = end + 1;
  }
  return result;
}

}  // namespace mpm
