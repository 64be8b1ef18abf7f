#include <mpm/core/folded.hpp>

#include <algorithm>

namespace mpm {

std::string folded(const std::string& text, std::size_t indent)
{
  constexpr std::size_t width = 80;
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

}  // namespace mpm
