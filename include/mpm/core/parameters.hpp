#pragma once
/// What a kind in a list (one_of.hpp) asks of the scene, as data, and what the scene answers.

#include <mpm/core/bound.hpp>
#include <mpm/core/formula.hpp>
#include <mpm/core/quantity.hpp>

#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mpm {

/// Straight lines over time.
struct TimeTable {
  struct Row {
    double time;                 ///< s
    std::vector<double> values;  ///< one per axis
    bool operator==(const Row&) const = default;
  };
  std::vector<Row> rows{};  ///< times ascending; none: no table

  bool empty() const { return rows.empty(); }
  bool operator==(const TimeTable&) const = default;
};

/// Of an upright box, m; one coordinate per axis.
struct Corners {
  std::vector<double> lower{}, upper{};

  bool empty() const { return lower.empty(); }
  bool operator==(const Corners&) const = default;
};

/// Numbers in SI units, or a word.
using ParameterValue =
    std::variant<double, std::vector<double>, std::string, Formulas, TimeTable, Corners>;

/// What a key takes that takes no word.
enum class ParameterType {
  number,
  vector,      ///< a number per axis
  formulas,    ///< a formula per axis
  time_table,  ///< times, each with a number per axis; may be empty
  box          ///< may be empty
};

/// One key of a kind.
struct KindParameter {
  std::string key;
  std::string help;
  ParameterType type = ParameterType::number;
  Quantity quantity = Quantity::number;
  Bound bound{};
  /// Of what is no word: without one the key is required.
  std::optional<ParameterValue> fallback{};
  /// A number, or each component, that makes sense beside the other keys: the tests over all
  /// laws and loads take it.
  double example = 0;
  /// The words that may be given; the first is the default. Without any it takes no word.
  std::vector<std::string> choices{};
  bool required = false;  ///< of a word: there is no default
  /// Only where that key of the same kind has that word.
  struct Only {
    std::string key, word;
    bool operator==(const Only&) const = default;
  };
  std::optional<Only> only{};

  bool operator==(const KindParameter&) const = default;
  /// What it is where nobody says; nothing if it is required.
  std::optional<ParameterValue> default_value() const
  {
    if (choices.empty()) return fallback;
    return required ? std::nullopt : std::optional<ParameterValue>(choices.front());
  }
};

/// Values by key.
class ParameterValues {
 public:
  ParameterValues() = default;
  ParameterValues(std::initializer_list<std::pair<const std::string, ParameterValue>> values)
      : values_(values)
  {
  }

  bool has(std::string_view key) const { return values_.contains(key); }
  /// Nothing without a value.
  const ParameterValue* find(std::string_view key) const
  {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : &found->second;
  }
  void set(const std::string& key, ParameterValue value) { values_[key] = std::move(value); }
  /// Throw std::out_of_range without a value, std::bad_variant_access for one of another type.
  double number(std::string_view key) const { return std::get<double>(at(key)); }
  const std::vector<double>& vector(std::string_view key) const
  {
    return std::get<std::vector<double>>(at(key));
  }
  const std::string& word(std::string_view key) const { return std::get<std::string>(at(key)); }
  const Formulas& formulas(std::string_view key) const { return std::get<Formulas>(at(key)); }
  const TimeTable& table(std::string_view key) const { return std::get<TimeTable>(at(key)); }
  const Corners& corners(std::string_view key) const { return std::get<Corners>(at(key)); }

  bool operator==(const ParameterValues&) const = default;

 private:
  const ParameterValue& at(std::string_view key) const
  {
    const ParameterValue* value = find(key);
    if (!value) throw std::out_of_range("no value of " + std::string(key));
    return *value;
  }
  std::map<std::string, ParameterValue, std::less<>> values_;
};

/// A value that does not go with others.
struct Contradiction {
  std::string key, reason;
};

/// Gives every key of a row of a list that has no value its default.
template <class Row>
void fill_defaults(const Row& row, ParameterValues& values)
{
  for (const KindParameter& parameter : row.parameters)
    if (const auto value = parameter.default_value(); value && !values.has(parameter.key))
      values.set(parameter.key, *value);
}

}  // namespace mpm
