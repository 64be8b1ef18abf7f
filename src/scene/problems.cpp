#include <mpm/core/error.hpp>
#include <mpm/scene/problems.hpp>

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace mpm::scene {

void Problems::add(const Place& place, const std::string& path, const std::string& text)
{
  found_.push_back({place, path, text});
}

bool Problems::concern(std::string_view path) const
{
  return std::ranges::any_of(found_, [&](const Problem& problem) {
    if (!problem.path.starts_with(path)) return false;
    return problem.path.size() == path.size() || problem.path[path.size()] == '.' ||
           problem.path[path.size()] == '[';
  });
}

void Problems::throw_if_any() const
{
  if (found_.empty()) return;
  std::vector<Problem> sorted = found_;
  std::ranges::stable_sort(sorted, {}, [](const Problem& problem) {
    return std::tuple(problem.place.line == 0, problem.place.line, problem.place.column);
  });
  std::vector<std::string> lines;
  for (const Problem& problem : sorted) lines.push_back(problem.place.text() + ": " + problem.text);
  throw InputError(lines);
}

bool Given::refuse(const std::string& reason, const std::string& remedy) const
{
  problems.add(node.place, path,
               fmt::format("{} is {} ({}).{}", path, node.shown(), reason,
                           remedy.empty() ? "" : " " + remedy + "."));
  return false;
}

Given Given::item(std::size_t index) const
{
  return {node.items[index], fmt::format("{}[{}]", path, index), problems,
          definitions};
}

Given Given::entry(const Entry& entry) const
{
  return {entry.value, path.empty() ? entry.key : path + "." + entry.key, problems, definitions};
}

}  // namespace mpm::scene
