#pragma once
/// What a law asks of the scene, as data, and what the scene answers.

#include <mpm/core/bound.hpp>
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

/// A number or the components of a vector in SI units, or a word.
using ParameterValue = std::variant<double, std::vector<double>, std::string>;

/// One key of a law.
struct LawParameter {
  std::string key;
  std::string help;
  Quantity quantity = Quantity::number;
  Bound bound{};
  /// Of a number or a vector: without one the key is required.
  std::optional<ParameterValue> fallback{};
  /// A value that makes sense beside those of the other keys: the tests over all laws take it.
  double example = 0;
  /// The words that may be given; the first is the default. Without any it takes a number.
  std::vector<std::string> choices{};
  /// Only where that key of the same law has that word.
  struct Only {
    std::string key, word;
    bool operator==(const Only&) const = default;
  };
  std::optional<Only> only{};

  bool operator==(const LawParameter&) const = default;
  /// What it is where nobody says; nothing if it is required.
  std::optional<ParameterValue> default_value() const
  {
    return choices.empty() ? fallback : ParameterValue(choices.front());
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

}  // namespace mpm
