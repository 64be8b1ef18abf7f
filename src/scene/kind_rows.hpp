#pragma once
/// The keys that the kinds of a list (core/one_of.hpp) ask for, as rows of the map that names one
/// of them. The map's struct has the choice as a member, and `values`.

#include <mpm/scene/schema.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace mpm::scene {

/// A parameter and the kinds that have it, word for word the same.
struct SharedParameter {
  KindParameter parameter;
  std::vector<std::string> kinds;
};

template <class Row>
std::vector<SharedParameter> shared_parameters()
{
  std::vector<SharedParameter> list;
  for (const Row& kind : list_of<Row>())
    for (const KindParameter& parameter : kind.parameters) {
      KindParameter shown = parameter;
      shown.example = 0;  // of the kind, not of the key
      auto same = std::ranges::find(list, shown, &SharedParameter::parameter);
      if (same == list.end()) same = list.insert(same, {shown, {}});
      same->kinds.push_back(kind.keyword);
    }
  return list;
}

/// What the scene says, or the default.
inline std::optional<ParameterValue> value_of(const ParameterValues& values,
                                              const KindParameter& parameter)
{
  const ParameterValue* given = values.find(parameter.key);
  return given ? *given : parameter.default_value();
}

/// `key`: of the word that chooses the kind.
template <class Owner, class Row>
Condition<Owner> condition_of(const SharedParameter& shared, const std::string& key,
                              OneOf<Row> Owner::*kind)
{
  const auto only = shared.parameter.only;
  const auto has_word = [only, kind](const Owner& owner) {
    const auto& parameters = (owner.*kind)->parameters;
    const auto found = std::ranges::find(parameters, only->key, &KindParameter::key);
    return found != parameters.end() &&
           value_of(owner.values, *found) == ParameterValue(only->word);
  };
  return {[kinds = shared.kinds, only, kind, has_word](const Owner& owner) {
            return std::ranges::find(kinds, (owner.*kind)->keyword) != kinds.end() &&
                   (!only || has_word(owner));
          },
          key + " " + alternatives(shared.kinds) +
              (only ? " with " + only->key + " " + only->word : "")};
}

// How the scene holds what the kinds take: as many components as the scene has axes are read and
// written.
inline ParameterValue held(double number)
{
  return number;
}
inline ParameterValue held(const PerAxis<double>& components)
{
  return std::vector<double>(components.begin(), components.end());
}
inline ParameterValue held(const PerAxis<Formula>& formulas)
{
  return Formulas(formulas.begin(), formulas.end());
}
inline ParameterValue held(const TimeTable& table)
{
  return table;
}
inline ParameterValue held(const Box& box)
{
  return Corners{{box.lower.begin(), box.lower.end()}, {box.upper.begin(), box.upper.end()}};
}
inline void take(const ParameterValue& value, double& number)
{
  number = std::get<double>(value);
}
inline void take(const ParameterValue& value, PerAxis<double>& components)
{
  std::ranges::copy(std::get<std::vector<double>>(value), components.begin());
}
inline void take(const ParameterValue& value, PerAxis<Formula>& formulas)
{
  std::ranges::copy(std::get<Formulas>(value), formulas.begin());
}
inline void take(const ParameterValue& value, TimeTable& table)
{
  table = std::get<TimeTable>(value);
}
inline void take(const ParameterValue& value, Box& box)
{
  const auto& [lower, upper] = std::get<Corners>(value);
  std::ranges::copy(lower, box.lower.begin());
  std::ranges::copy(upper, box.upper.begin());
}

/// Of a table or box that may be left out.
inline bool is_empty(const ParameterValue& value)
{
  return value == ParameterValue(TimeTable{}) || value == ParameterValue(Corners{});
}

template <class T>
bool read_value(const Given& given, const Rule& rule, T& value)
{
  return Value<T>::read(given, rule, value);
}
inline bool read_value(const Given& given, const Rule& rule, Box& box)
{
  if (!Value<Box>::read(given, rule, box)) return false;
  const auto defect = box.defect(rule.dimensions);
  return defect ? given.refuse(defect->key + " " + defect->reason) : true;
}

template <class Owner, class T>
Parameter<Owner> row_of_values(const KindParameter& p)
{
  const Rule rule{p.quantity, p.bound};
  return {p.key,
          p.help,
          Value<T>::describe(rule),
          p.fallback ? Need::optional : Need::required,
          p.fallback && is_empty(*p.fallback) ? "none" : "",
          false,
          [p, rule](const Given& given, Owner& owner, int dimensions) {
            Rule here = rule;
            here.dimensions = dimensions;
            T value{};
            const bool good = read_value(given, here, value);
            if (good) owner.values.set(p.key, held(value));
            return good;
          },
          [p, rule](const Owner& owner, int dimensions) {
            Rule here = rule;
            here.dimensions = dimensions;
            T value{};
            const auto found = value_of(owner.values, p);
            if (found && is_empty(*found)) return Node{};
            if (found) take(*found, value);
            return Value<T>::write(value, here);
          },
          [rule] { return Value<T>::schema(rule); }};
}

template <class Owner>
Parameter<Owner> row_of_words(const KindParameter& p)
{
  return {p.key,
          p.help,
          words_as_code(p.choices),
          p.required ? Need::required : Need::optional,
          "",
          true,
          [p](const Given& given, Owner& owner, int) {
            const auto place = read_word(given, p.choices);
            if (place) owner.values.set(p.key, p.choices[*place]);
            return place.has_value();
          },
          [p](const Owner& owner, int) {
            return Node::of(std::get<std::string>(*value_of(owner.values, p)));
          },
          [p] { return words_schema(p.choices); }};
}

template <class Owner>
Parameter<Owner> row_of(const KindParameter& p)
{
  if (!p.choices.empty()) return row_of_words<Owner>(p);
  switch (p.type) {
    case ParameterType::vector:
      return row_of_values<Owner, PerAxis<double>>(p);
    case ParameterType::formulas:
      return row_of_values<Owner, PerAxis<Formula>>(p);
    case ParameterType::time_table:
      return row_of_values<Owner, TimeTable>(p);
    case ParameterType::box:
      return row_of_values<Owner, Box>(p);
    default:
      return row_of_values<Owner, double>(p);
  }
}

/// Appends a row for each key of each kind.
template <class Owner, class Row>
void add_kind_rows(std::vector<Parameter<Owner>>& list, const std::string& key,
                   OneOf<Row> Owner::*kind)
{
  for (const SharedParameter& shared : shared_parameters<Row>())
    list.push_back(row_of<Owner>(shared.parameter).when(condition_of(shared, key, kind)));
}

}  // namespace mpm::scene
