#pragma once
/// A key of the scene as one row of data, and what follows from lists of such rows: reading with
/// every check, writing back, describing, and the JSON schema.

#include <mpm/scene/value.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::scene {

enum class Need { optional, required };

/// When a row belongs to its map at all: `holds` looks at the rows read before it.
template <class Owner>
struct Condition {
  std::function<bool(const Owner&)> holds;
  std::string text;  ///< `law von_mises`
};

/// What stands in a row beside key, member and help.
struct Traits {
  Quantity quantity = Quantity::number;
  Bound bound{};
  bool spread = false;
  Need need = Need::optional;
  bool decides = false;        ///< conditions of later rows look at it (always so for a choice)
  std::string default_text{};  ///< where the default is computed
  std::string excludes{};      ///< another key of the map, which does not go with this one
};

template <class Owner>
struct Parameter {
  std::string key;
  std::string help;
  std::string type;
  Need need;
  std::string default_text;
  bool decides;
  std::function<bool(const Given&, Owner&, int dimensions)> read;
  std::function<Node(const Owner&, int dimensions)> write;  ///< Kind::nothing: left out
  std::function<Json()> schema;
  std::string excludes{};  ///< as in Traits
  Condition<Owner> condition{};
  std::optional<int> dimensions{};  ///< of the scenes that it belongs to; nothing: any

  bool applies(const Owner& owner, int dimensions_of_scene) const
  {
    return dimensions.value_or(dimensions_of_scene) == dimensions_of_scene &&
           (!condition.holds || condition.holds(owner));
  }
  /// What it belongs to: `law von_mises`; empty: any.
  std::string only() const
  {
    if (!dimensions) return condition.text;
    const std::string where = *dimensions == 2 ? "scenes in the plane" : "scenes in space";
    return condition.text.empty() ? where : condition.text + " in " + where;
  }
  Parameter when(Condition<Owner> only) &&
  {
    condition = std::move(only);
    return std::move(*this);
  }
  Parameter in_plane() &&
  {
    dimensions = 2;
    return std::move(*this);
  }
  Parameter in_space() &&
  {
    dimensions = 3;
    return std::move(*this);
  }
};

/// The list of keys of each struct that a map describes; defined in schema_*.cpp.
template <class Owner>
const std::vector<Parameter<Owner>>& parameters();
/// Of structs that bring their own.
template <class Owner>
requires requires
{
  Owner::rows();
}
const std::vector<Parameter<Owner>>& parameters()
{
  return Owner::rows();
}

/// The name of the list on the reference page; specialised for each struct that is a map.
template <class Owner>
inline constexpr std::string_view section{};
template <class Owner>
requires requires
{
  Owner::keyword;
}
inline constexpr std::string_view section<Owner> = Owner::keyword;

/// A row whose value is computed from several members.
template <class T, class Owner>
Parameter<Owner> property(std::string key, std::function<T(const Owner&)> get,
                          std::function<void(Owner&, T)> set, const Traits& traits,
                          std::string help)
{
  const Rule rule{traits.quantity, traits.bound, traits.spread};
  return {std::move(key),
          std::move(help),
          Value<T>::describe(rule),
          traits.need,
          traits.default_text,
          traits.decides || is_choice<T>,
          [rule, get, set](const Given& given, Owner& owner, int dimensions) {
            Rule here = rule;
            here.dimensions = dimensions;
            T value = get(owner);
            const bool good = Value<T>::read(given, here, value);
            if (good || (keeps_parts<T> && given.node.kind != Node::Kind::scalar))
              set(owner, std::move(value));
            return good;
          },
          [rule, get](const Owner& owner, int dimensions) {
            Rule here = rule;
            here.dimensions = dimensions;
            return Value<T>::write(get(owner), here);
          },
          [rule] { return Value<T>::schema(rule); },
          traits.excludes};
}

/// A row for a member.
template <class Owner, class T, class Base>
Parameter<Owner> member(std::string key, T Base::*pointer, const Traits& traits, std::string help)
{
  return property<T, Owner>(
      std::move(key), [pointer](const Owner& owner) { return owner.*pointer; },
      [pointer](Owner& owner, T value) { owner.*pointer = std::move(value); }, traits,
      std::move(help));
}

template <class Owner>
std::vector<std::string> keys(const std::vector<Parameter<Owner>>& rows)
{
  std::vector<std::string> names;
  for (const auto& row : rows)
    if (std::ranges::find(names, row.key) == names.end()) names.push_back(row.key);
  return names;
}

/// Reports keys that are unknown or given twice; returns the keys they were probably meant for.
std::vector<std::string> check_keys(const Given& given, const std::vector<std::string>& known);

void report_foreign(const Given& map, const Entry& entry, const std::string& belongs_to);
void report_excluded(const Given& map, const Entry& entry, const Entry& other);
void report_missing(const Given& map, const std::string& key, const std::string& help,
                    const std::string& type);
/// `a map: [material](#material)`
std::string link_to(std::string_view section);
/// `#/definitions/free_motion`
std::string schema_reference(std::string_view section);

inline std::string joined(const std::string& path, const std::string& key)
{
  return path.empty() ? key : path + "." + key;
}

/// Reads a map of a scene of so many dimensions row by row, in the order of the list.
template <class Owner>
bool read_map(const Given& given, Owner& owner, int dimensions)
{
  const auto& rows = parameters<Owner>();
  if (given.node.kind == Node::Kind::scalar || given.node.kind == Node::Kind::list)
    return given.refuse("must be a map with keys such as " + rows.front().key + ": ...");

  const std::vector<std::string> meant = check_keys(given, keys(rows));
  bool good = meant.empty();
  // False once what conditions look at is unreadable: what depends on it is left unsaid.
  bool decided = std::ranges::none_of(rows, [&](const Parameter<Owner>& row) {
    return row.decides && std::ranges::find(meant, row.key) != meant.end();
  });
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Parameter<Owner>& row = rows[r];
    const bool applies = row.applies(owner, dimensions);
    // A key may have a row for each of several conditions.
    const auto other = std::ranges::find_if(rows, [&](const Parameter<Owner>& candidate) {
      return candidate.key == row.key && &candidate != &row &&
             (candidate.applies(owner, dimensions) || (!applies && &candidate < &row));
    });
    if (!applies && other != rows.end()) continue;

    if (const Entry* entry = given.node.find(row.key)) {
      const Given value = given.entry(*entry);
      if (applies) {
        if (const Entry* other = row.excludes.empty() ? nullptr : given.node.find(row.excludes)) {
          report_excluded(given, *entry, *other);
          good = false;
        }
        const bool read = row.read(value, owner, dimensions);
        if (!read && row.decides) decided = false;
        good &= read;
      } else if (decided) {
        report_foreign(given, *entry, row.only());
        good = false;
      }
    } else if (row.need == Need::required && applies && decided &&
               std::ranges::find(meant, row.key) == meant.end()) {
      report_missing(given, row.key, row.help, row.type);
      good = false;
    }
  }
  return good;
}

template <class Owner>
Node write_map(const Owner& owner, int dimensions)
{
  Node node;
  node.kind = Node::Kind::map;
  for (const auto& row : parameters<Owner>()) {
    if (!row.applies(owner, dimensions)) continue;
    Node value = row.write(owner, dimensions);
    if (value.kind != Node::Kind::nothing) node.entries.push_back({row.key, {}, std::move(value)});
  }
  return node;
}

/// Structs with a section are maps.
template <class T>
requires(!section<T>.empty()) inline constexpr bool keeps_parts<T> = true;

template <class T>
requires(!section<T>.empty()) struct Value<T> {
  static bool read(const Given& given, const Rule& rule, T& value)
  {
    return read_map(given, value, rule.dimensions);
  }
  static Node write(const T& value, const Rule& rule) { return write_map(value, rule.dimensions); }
  static std::string describe(const Rule&) { return link_to(section<T>); }
  static Json schema(const Rule&) { return {{"$ref", schema_reference(section<T>)}}; }
};

}  // namespace mpm::scene
