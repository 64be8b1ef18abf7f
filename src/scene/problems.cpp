#include <mpm/core/error.hpp>
#include <mpm/scene/problems.hpp>

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace mpm::scene {

namespace {
constexpr std::size_t most_shown = 20;   // fill a terminal
constexpr std::size_t most_kept = 1000;  // a file that is no scene has them without end
}  // namespace

void Problems::add(const Place& place, const std::string& path, const std::string& text)
{
  ++count_;
  if (found_.size() < most_kept) found_.push_back({place, path, text});
}

bool Problems::full() const
{
  return found_.size() >= most_kept;
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
  for (const Problem& problem : sorted) {
    if (lines.size() == most_shown) break;
    lines.push_back(problem.place.text() + ": " + problem.text);
  }
  if (count_ > lines.size())
    lines.push_back(fmt::format("and {} more problems. Mend these first.", count_ - lines.size()));
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
  return {node.items[index], fmt::format("{}[{}]", path, index), problems, definitions};
}

Given Given::entry(const Entry& entry) const
{
  return {entry.value, path.empty() ? entry.key : path + "." + entry.key, problems, definitions};
}

}  // namespace mpm::scene
