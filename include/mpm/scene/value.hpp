#pragma once
/// How a value of each type is read from the scene, written back and described.
///
/// Value<T>::read checks and stores; it returns false after reporting what is wrong.
/// Value<T>::write returns the node that reads back as the same value.
/// Value<T>::describe is the cell of the reference page.
/// Value<T>::schema is its part of the JSON schema: it takes what read takes, and may take more.

#include <mpm/core/bound.hpp>
#include <mpm/core/one_of.hpp>
#include <mpm/core/units.hpp>
#include <mpm/scene/names.hpp>
#include <mpm/scene/problems.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace mpm::scene {

using Json = nlohmann::ordered_json;

/// What a row of the parameter lists says about the numbers it takes.
struct Rule {
  Quantity quantity = Quantity::number;
  Bound bound{};
  bool spread = false;  ///< one value may stand for all entries of an array
  int dimensions = 2;   ///< of the scene that is read, written or described
};

template <class T>
struct Value;

/// A map, or a list of maps, keeps what could be read of it, so that other checks go on; any other
/// value is stored whole or not at all.
template <class T>
inline constexpr bool keeps_parts = false;
template <class T>
inline constexpr bool keeps_parts<std::optional<T>> = keeps_parts<T>;
template <class T>
inline constexpr bool keeps_parts<std::vector<T>> = keeps_parts<T>;

/// One scalar; reports a list, a map or nothing. `wanted`: `a word`.
bool is_scalar(const Given& given, const std::string& wanted, const std::string& remedy = "");
/// What makes a scene one in space or in the plane, for lists of the wrong length.
inline constexpr std::string_view why_in_space =
    "as specimen.size with three components, or specimen.depth, makes a scene in space";
inline constexpr std::string_view why_in_plane =
    "as the scene lies in the plane: neither has specimen.size three components nor is "
    "specimen.depth given";
/// a, b or c
std::string alternatives(const std::vector<std::string>& names);
/// `a`, `b` or `c`
std::string words_as_code(const std::vector<std::string>& names);
/// Place of the given word among these; reports any other, with the nearest.
std::optional<std::size_t> read_word(const Given& given, const std::vector<std::string>& names);

/// One of these; `helps`: what each of them means, if that is known.
Json words_schema(const std::vector<std::string>& words,
                  const std::vector<std::string>& helps = {});
/// A list of so many; `most` 0: of any length from `least` on.
Json list_schema(Json items, std::size_t least = 0, std::size_t most = 0);
/// What the rule's spread adds to a list.
Json one_or_list(const Rule& rule, Json one, Json list);

/// Choices of a word decide which other keys there are.
template <class T>
inline constexpr bool is_choice = std::is_enum_v<T>;
template <class Row>
inline constexpr bool is_choice<OneOf<Row>> = true;

template <>
struct Value<double> {
  static bool read(const Given& given, const Rule& rule, double& value);
  static Node write(const double& value, const Rule& rule);
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};

template <>
struct Value<long> {
  static bool read(const Given& given, const Rule& rule, long& value);
  static Node write(const long& value, const Rule&) { return Node::of(std::to_string(value)); }
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};

template <>
struct Value<int> {
  static bool read(const Given& given, const Rule& rule, int& value);
  static Node write(const int& value, const Rule&) { return Node::of(std::to_string(value)); }
  static std::string describe(const Rule& rule) { return Value<long>::describe(rule); }
  static Json schema(const Rule& rule) { return Value<long>::schema(rule); }
};

template <>
struct Value<bool> {
  static bool read(const Given& given, const Rule& rule, bool& value);
  static Node write(const bool& value, const Rule&) { return Node::of(value ? "true" : "false"); }
  static std::string describe(const Rule&) { return "`true` or `false`"; }
  static Json schema(const Rule& rule);
};

template <>
struct Value<std::string> {
  static bool read(const Given& given, const Rule& rule, std::string& value);
  static Node write(const std::string& value, const Rule&) { return Node::of_text(value); }
  static std::string describe(const Rule&) { return "text"; }
  static Json schema(const Rule& rule);
};

template <>
struct Value<std::filesystem::path> {
  static bool read(const Given& given, const Rule& rule, std::filesystem::path& value);
  static Node write(const std::filesystem::path& value, const Rule&)
  {
    return Node::of_text(value.string());
  }
  static std::string describe(const Rule&) { return "file, relative to the scene's folder"; }
  static Json schema(const Rule& rule);
};

/// A number with a unit stands for itself, any other text for a formula in SI units.
template <>
struct Value<Formula> {
  static bool read(const Given& given, const Rule& rule, Formula& value);
  static Node write(const Formula& value, const Rule& rule);
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};

/// A map of names to texts.
template <>
struct Value<Definitions> {
  static bool read(const Given& given, const Rule& rule, Definitions& definitions);
  static Node write(const Definitions& definitions, const Rule& rule);
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};

// Tables: at least two entries, times ascending.
template <>
struct Value<TimeTable> {
  static bool read(const Given& given, const Rule& rule, TimeTable& table);
  static Node write(const TimeTable& table, const Rule& rule);
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};
template <>
struct Value<MotionTable> {
  static bool read(const Given& given, const Rule& rule, MotionTable& table);
  static Node write(const MotionTable& table, const Rule& rule);
  static std::string describe(const Rule& rule);
  static Json schema(const Rule& rule);
};

template <class Choice>
requires std::is_enum_v<Choice>
struct Value<Choice> {
  static bool read(const Given& given, const Rule&, Choice& value)
  {
    const auto place = read_word(given, all_names<Choice>());
    if (place) value = names_of<Choice>[*place].value;
    return place.has_value();
  }
  static Node write(const Choice& value, const Rule&)
  {
    return Node::of(std::string(name_of(value)));
  }
  static std::string describe(const Rule&) { return words_as_code(all_names<Choice>()); }
  static Json schema(const Rule&) { return words_schema(all_names<Choice>()); }
};

/// A row of a list, by its keyword.
template <class Row>
struct Value<OneOf<Row>> {
  static bool read(const Given& given, const Rule&, OneOf<Row>& value)
  {
    const auto place = read_word(given, keywords<Row>());
    if (place) value = OneOf<Row>(list_of<Row>()[*place].keyword);
    return place.has_value();
  }
  static Node write(const OneOf<Row>& value, const Rule&)
  {
    return Node::of(std::string(value->keyword));
  }
  static std::string describe(const Rule&) { return words_as_code(keywords<Row>()); }
  static Json schema(const Rule&)
  {
    std::vector<std::string> helps;
    for (const Row& row : list_of<Row>()) helps.emplace_back(row.help);
    return words_schema(keywords<Row>(), helps);
  }
};

template <class T>
struct Value<std::optional<T>> {
  static bool read(const Given& given, const Rule& rule, std::optional<T>& value)
  {
    T inner{};
    const bool good = Value<T>::read(given, rule, inner);
    if (good || keeps_parts<T>) value = std::move(inner);
    return good;
  }
  static Node write(const std::optional<T>& value, const Rule& rule)
  {
    return value ? Value<T>::write(*value, rule) : Node{};
  }
  static std::string describe(const Rule& rule) { return Value<T>::describe(rule); }
  static Json schema(const Rule& rule) { return Value<T>::schema(rule); }
};

/// The entries of a list of so many, or the one value that stands for all; `wanted`: `a list of 2`.
template <class T>
bool read_entries(const Given& given, const Rule& rule, std::span<T> values,
                  const std::string& wanted)
{
  if (rule.spread && given.node.kind != Node::Kind::list) {
    if (!Value<T>::read(given, rule, values[0])) return false;
    std::ranges::fill(values, values[0]);
    return true;
  }
  if (given.node.kind != Node::Kind::list || given.node.items.size() != values.size())
    return given.refuse("must be " + wanted);
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i)
    good &= Value<T>::read(given.item(i), rule, values[i]);
  return good;
}

template <class T>
Node write_entries(std::span<const T> values, const Rule& rule)
{
  Node node;
  node.kind = Node::Kind::list;
  for (const T& value : values) node.items.push_back(Value<T>::write(value, rule));
  return node;
}

template <class T, std::size_t N>
struct Value<std::array<T, N>> {
  static bool read(const Given& given, const Rule& rule, std::array<T, N>& values)
  {
    std::array<T, N> inner = values;
    const bool good = read_entries<T>(given, rule, inner, words());
    if (good) values = inner;
    return good;
  }
  static Node write(const std::array<T, N>& values, const Rule& rule)
  {
    return write_entries<T>(values, rule);
  }
  static std::string describe(const Rule& rule)
  {
    return (rule.spread ? "one value or " : "") + words() + ": " + Value<T>::describe(rule);
  }
  static Json schema(const Rule& rule)
  {
    const Json one = Value<T>::schema(rule);
    return one_or_list(rule, one, list_schema(one, N, N));
  }

 private:
  static std::string words() { return "a list of " + std::to_string(N); }
};

template <class T, std::size_t InPlane, std::size_t InSpace>
struct Value<PlaneOrSpace<T, InPlane, InSpace>> {
  using Values = PlaneOrSpace<T, InPlane, InSpace>;

  static bool read(const Given& given, const Rule& rule, Values& values)
  {
    Values inner = values;
    const bool good =
        read_entries<T>(given, rule, std::span(inner).first(Values::count(rule.dimensions)),
                        words(rule.dimensions, given.node.items.size()));
    if (good) values = inner;
    return good;
  }
  static Node write(const Values& values, const Rule& rule)
  {
    return write_entries<T>(std::span(values).first(Values::count(rule.dimensions)), rule);
  }
  static std::string describe(const Rule& rule)
  {
    return (rule.spread ? "one value or a list of " : "a list of ") + std::to_string(InPlane) +
           " (in space " + std::to_string(InSpace) + "): " + Value<T>::describe(rule);
  }
  static Json schema(const Rule& rule)
  {
    const Json one = Value<T>::schema(rule);
    return one_or_list(rule, one, list_schema(one, InPlane, InSpace));
  }

 private:
  static std::string words(int dimensions, std::size_t given)
  {
    const std::string wanted = "a list of " + std::to_string(Values::count(dimensions));
    if (given == InPlane && dimensions == 3) return wanted + ", " + std::string(why_in_space);
    if (given == InSpace && dimensions == 2) return wanted + ", " + std::string(why_in_plane);
    return wanted;
  }
};

template <class T>
struct Value<std::vector<T>> {
  static bool read(const Given& given, const Rule& rule, std::vector<T>& values)
  {
    if (given.node.kind != Node::Kind::list) return given.refuse("must be a list");
    std::vector<T> inner(given.node.items.size());
    bool good = true;
    for (std::size_t i = 0; i < inner.size(); ++i)
      good &= Value<T>::read(given.item(i), rule, inner[i]);
    if (good || keeps_parts<T>) values = std::move(inner);
    return good;
  }
  static Node write(const std::vector<T>& values, const Rule& rule)
  {
    Node node;
    node.kind = Node::Kind::list;
    for (const T& value : values) node.items.push_back(Value<T>::write(value, rule));
    return node;
  }
  static std::string describe(const Rule& rule) { return "a list: " + Value<T>::describe(rule); }
  static Json schema(const Rule& rule) { return list_schema(Value<T>::schema(rule)); }
};

}  // namespace mpm::scene
