#include <mpm/core/error.hpp>
#include <mpm/core/printable.hpp>
#include <mpm/core/units.hpp>
#include <mpm/scene/document.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "yaml_tree.hpp"
#include <fmt/format.h>

namespace mpm::scene {

std::string Place::text() const
{
  return line > 0 ? fmt::format("{}:{}:{}", origin, line, column) : origin;
}

Node Node::of(std::string plain_scalar)
{
  Node node;
  node.kind = Kind::scalar;
  node.scalar = std::move(plain_scalar);
  return node;
}

Node Node::of_text(std::string scalar)
{
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
  const bool starts_as_word = !scalar.empty() && scalar[0] != '-' && scalar != "null" &&
                              scalar != "Null" && scalar != "NULL";
  Node node = of(std::move(scalar));
  node.quoted = !starts_as_word || node.scalar.find_first_not_of(plain) != std::string::npos;
  return node;
}

const Entry* Node::find(std::string_view key) const
{
  const auto entry = std::ranges::find(entries, key, &Entry::key);
  return entry == entries.end() ? nullptr : &*entry;
}

Entry* Node::find(std::string_view key)
{
  const auto entry = std::ranges::find(entries, key, &Entry::key);
  return entry == entries.end() ? nullptr : &*entry;
}

std::string Node::shown() const
{
  switch (kind) {
    case Kind::nothing:
      return "empty";
    case Kind::scalar:
      return !quoted && split_number_and_unit(scalar) ? shortened(scalar)
                                                      : fmt::format("'{}'", shortened(scalar));
    case Kind::map:
      return "a map";
    case Kind::list:
      break;
  }
  std::string text = "[";
  for (const Node& item : items) {
    if (text.size() > 60) return text + ", ...]";
    text += (text.size() > 1 ? ", " : "") + item.shown();
  }
  return text + "]";
}

std::vector<std::string> split_path(std::string_view path)
{
  std::vector<std::string> steps;
  while (!path.empty()) {
    const bool index = path.front() == '[';
    const std::size_t end =
        index ? path.find(']') + 1 : std::min(path.find_first_of(".["), path.size());
    if (end == 0) return {};
    steps.emplace_back(path.substr(0, end));
    if (index && !list_index(steps.back())) return {};
    path.remove_prefix(end);
    if (path == ".") return {};
    if (path.starts_with('.')) {
      path.remove_prefix(1);
      if (path.starts_with('[')) return {};
    } else if (!path.empty() && path.front() != '[') {
      return {};
    }
  }
  return steps;
}

std::optional<std::size_t> list_index(std::string_view step)
{
  if (step.size() < 3 || step.front() != '[' || step.back() != ']') return std::nullopt;
  std::size_t index = 0;
  const char* last = step.data() + step.size() - 1;
  const auto [end, status] = std::from_chars(step.data() + 1, last, index);
  if (status != std::errc{} || end != last) return std::nullopt;
  return index;
}

namespace {
/// Walks as far as the path exists; returns what stands at its end, or nullptr.
const Node* walk(const Node& root, std::string_view path, Place& nearest)
{
  const Node* node = &root;
  nearest = root.place;
  for (const std::string& step : split_path(path)) {
    if (const auto index = list_index(step)) {
      if (*index >= node->items.size()) return nullptr;
      node = &node->items[*index];
      nearest = node->place;
    } else {
      const Entry* entry = node->find(step);
      if (entry == nullptr) return nullptr;
      node = &entry->value;
      nearest = node->place;
    }
  }
  return node;
}
}  // namespace

const Node* find(const Node& root, std::string_view path)
{
  Place nearest;
  return walk(root, path, nearest);
}

Place place_of(const Node& root, std::string_view path)
{
  Place nearest;
  walk(root, path, nearest);
  return nearest;
}

Node read_document(const std::filesystem::path& file)
{
  namespace fs = std::filesystem;
  const std::string name = file.string();
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw InputError(name +
                     ": no such scene file. Check the path (it counts from the working "
                     "directory).");
  if (fs::is_directory(file, ignored))
    throw InputError(name + ": is a directory. Name the scene file inside it.");
  // A device or a pipe may have no end, and gives each rank another part of what it has.
  if (!fs::is_regular_file(file, ignored))
    throw InputError(name + ": is not a file. Save the scene, and name the file.");
  constexpr std::uintmax_t most_bytes = 1'000'000;
  if (fs::file_size(file, ignored) > most_bytes)
    throw InputError(
        fmt::format("{}: has {} bytes (a scene has some thousand; at most {}). Name the scene, not "
                    "a picture or results; what is large belongs in a picture.",
                    name, fs::file_size(file, ignored), most_bytes));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream.is_open()) throw InputError(name + ": cannot be read. Check its permissions.");
  Node root = parse_yaml(text.str(), name, false);
  if (root.kind == Node::Kind::nothing)
    throw InputError(name + ": is empty. A scene needs at least 'specimen' and 'loading'.");
  if (root.kind != Node::Kind::map)
    throw InputError(
        fmt::format("{}: the scene is {} (must be a map of keys). Begin with e.g. "
                    "'specimen:' and 'loading:'.",
                    root.place.text(), root.shown()));
  root.place = {name, 1, 1};
  return root;
}

}  // namespace mpm::scene
