#pragma once
/// A YAML file as a plain tree in which every key and value knows where it was written.

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::scene {

/// Where something was written: a file with line and column (from 1), or a --set option.
struct Place {
  std::string origin;
  int line = 0;  ///< 0: the origin as a whole
  int column = 0;

  std::string text() const;  ///< `inputs/a.yaml:3:5` or `--set loading.speed=3`
};

struct Entry;

struct Node {
  enum class Kind { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  Place place;
  std::string scalar;
  bool quoted = false;
  std::vector<Node> items;     ///< of a list
  std::vector<Entry> entries;  ///< of a map, in file order, duplicates included

  static Node of(std::string plain_scalar);
  static Node of_text(std::string scalar);  ///< quoted where YAML would misread it plain

  const Entry* find(std::string_view key) const;
  Entry* find(std::string_view key);
  std::string shown() const;  ///< for messages: `10 mm`, `'fast'`, `[1, 2]`, `a map`
};

struct Entry {
  std::string key;
  Place place;
  Node value;
};

/// `a.b[2].c` apart: keys, and list positions as `[2]`. Empty if malformed.
std::vector<std::string> split_path(std::string_view path);
/// The position in a step `[2]`; nothing for a key.
std::optional<std::size_t> list_index(std::string_view step);

/// What stands at a path, or nullptr.
const Node* find(const Node& root, std::string_view path);
/// Where a path was written: of its value, or of the nearest part of it that exists.
Place place_of(const Node& root, std::string_view path);

/// Throws InputError: no such file, a directory, unreadable, bad YAML, empty, not a map.
Node read_document(const std::filesystem::path& file);

/// Sets one `path.to.key=value`; keys that do not exist are created. Throws InputError.
void apply_override(Node& root, const std::string& assignment);

/// A scalar, a list of scalars or an empty map as YAML on one line.
std::string one_line(const Node& node);
/// As YAML: maps in blocks, lists of scalars on one line.
void print_document(std::ostream& out, const Node& root);

}  // namespace mpm::scene
