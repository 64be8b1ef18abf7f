#include <mpm/scene/scene_changes.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

#include "yaml_tree.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

using Values = std::map<std::string, std::string>;

void list_values(const Node& node, const std::string& path, Values& values)
{
  for (const Entry& entry : node.entries)
    list_values(entry.value, path.empty() ? entry.key : path + '.' + entry.key, values);
  for (std::size_t k = 0; k < node.items.size(); ++k)
    list_values(node.items[k], fmt::format("{}[{}]", path, k), values);
  if (node.kind == Node::Kind::scalar) values[path] = one_line(node);
}

bool may_change(const std::string& path)
{
  static const std::vector<std::string> free{"loading.strain", "free_motion.end_time", "steps",
                                             "numerics.cfl",   "numerics.recovery",    "name",
                                             "title"};
  // Borders are those of the checkpoint, or made anew on other ranks.
  return path.starts_with("output.") || path.starts_with("numerics.ranks") ||
         std::ranges::find(free, path) != free.end();
}

}  // namespace

std::vector<std::string> changes_that_matter(const std::string& before, const std::string& now)
{
  Values old_values, new_values;
  list_values(parse_yaml(before, "checkpoint", true), "", old_values);
  list_values(parse_yaml(now, "scene", true), "", new_values);
  std::vector<std::string> changes;
  const auto shown = [](const Values& values, const std::string& path) {
    const auto found = values.find(path);
    return found == values.end() ? "not given" : found->second;
  };
  // The folder of a project may be another one now; its bytes are compared beside.
  const auto counts = [](const std::string& path, const std::string& value) {
    return path == "specimen.micrograph" ? std::filesystem::path(value).filename().string() : value;
  };
  Values all = old_values;
  all.insert(new_values.begin(), new_values.end());
  for (const auto& [path, value] : all) {
    const std::string was = shown(old_values, path), is = shown(new_values, path);
    if (counts(path, was) != counts(path, is) && !may_change(path))
      changes.push_back(fmt::format("{} was {} and is {}", path, was, is));
  }
  return changes;
}

}  // namespace mpm::scene
