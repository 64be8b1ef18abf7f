#include <mpm/core/nearest_name.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <vector>

namespace mpm {

namespace {
bool same_letter(char a, char b)
{
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}
}  // namespace

int edit_distance(std::string_view a, std::string_view b)
{
  const std::size_t width = b.size() + 1;
  std::vector<int> d((a.size() + 1) * width);  // d(i, j): first i letters of a to first j of b
  for (std::size_t i = 0; i <= a.size(); ++i) d[i * width] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) d[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = same_letter(a[i - 1], b[j - 1]) ? 0 : 1;
      int& here = d[i * width + j];
      here = std::min({d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1,
                       d[(i - 1) * width + j - 1] + replace});
      const bool swapped =
          i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]);
      if (swapped) here = std::min(here, d[(i - 2) * width + j - 2] + 1);
    }
  }
  return d.back();
}

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names)
{
  std::optional<std::string> nearest;
  int fewest = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& name : names) {
    // Each letter that one has more is a change: most names need no table.
    const int more = std::abs(int(word.size()) - int(name.size()));
    if (more >= std::min(fewest, int(name.size()))) continue;
    const int changes = edit_distance(word, name);
    if (changes < fewest && changes < static_cast<int>(name.size())) {
      fewest = changes;
      nearest = name;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view word, std::span<const std::string> names)
{
  if (const auto name = nearest_name(word, names)) return "did you mean '" + *name + "'?";
  std::string text = "known:";
  for (std::size_t i = 0; i < names.size(); ++i) text += (i > 0 ? ", " : " ") + names[i];
  return text;
}

}  // namespace mpm
