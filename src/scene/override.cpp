#include <mpm/core/error.hpp>
#include <mpm/core/printable.hpp>
#include <mpm/scene/document.hpp>

#include "yaml_tree.hpp"
#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// `material.density` also reaches the only entry of `materials`, and `materials[0]` the
/// `material`.
void reach_single_material(const Node& root, std::vector<std::string>& steps)
{
  const Entry* list = root.find("materials");
  if (steps[0] == "material" && list != nullptr && list->value.items.size() == 1) {
    steps[0] = "materials";
    steps.insert(steps.begin() + 1, "[0]");
  } else if (steps.size() > 1 && steps[0] == "materials" && steps[1] == "[0]" && list == nullptr) {
    steps[0] = "material";
    steps.erase(steps.begin() + 1);
  }
}

}  // namespace

void apply_override(Node& root, const std::string& assignment)
{
  const std::string origin = "--set " + shortened(assignment, 120);
  const std::size_t equals = assignment.find('=');
  std::vector<std::string> steps = split_path(assignment.substr(0, equals));
  if (equals == std::string::npos || steps.empty() || list_index(steps[0]))
    throw InputError(origin +
                     ": is no assignment. Write --set path.to.key=value, e.g. --set "
                     "loading.speed='10 m/s'.");
  reach_single_material(root, steps);

  Node* node = &root;
  std::string path;
  for (const std::string& step : steps) {
    if (const auto index = list_index(step)) {
      if (*index >= node->items.size())
        throw InputError(fmt::format("{}: there is no {}{} ({} has {} entries). Count them from 0.",
                                     origin, path, step, path, node->items.size()));
      node = &node->items[*index];
      path += step;
      continue;
    }
    if (node->kind == Node::Kind::nothing) node->kind = Node::Kind::map;
    if (node->place.origin.empty()) node->place = {origin};  // a map that this option makes
    if (node->kind != Node::Kind::map)
      throw InputError(fmt::format("{}: {} is {} (has no key '{}'). Set {} as a whole.", origin,
                                   path, node->shown(), step, path));
    if (node->find(step) == nullptr) node->entries.push_back({step, {origin}, {}});
    node = &node->find(step)->value;
    path += (path.empty() ? "" : ".") + step;
  }
  *node = parse_yaml(assignment.substr(equals + 1), origin, true);
  node->place = {origin};
}

}  // namespace mpm::scene
