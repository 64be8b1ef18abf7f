#include <mpm/core/nearest_name.hpp>
#include <mpm/scene/value.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpm::scene {

namespace {

bool within(const Given& given, const Bound& bound, double value)
{
  const auto broken = bound.violation(value);
  return broken ? given.refuse(*broken) : true;
}

/// `10`, or another number that the bound admits.
std::string example_within(const Rule& rule)
{
  if (rule.quantity != Quantity::number) return std::string(example(rule.quantity));
  for (const char* number : {"10", "1", "0.3"})
    if (!rule.bound.violation(std::stod(number))) return number;
  return fmt::format("{}", 0.5 * (rule.bound.lower->value + rule.bound.upper->value));
}

bool read_number(const Given& given, const Rule& rule, double& value)
{
  const std::string remedy = "Write e.g. " + example_within(rule);
  if (!is_scalar(given, fmt::format("must be {}", noun(rule.quantity)), remedy)) return false;
  try {
    value = to_si(given.node.scalar, rule.quantity);
    return true;
  } catch (const UnitError& error) {
    return given.refuse(error.what(), rule.quantity == Quantity::number ? remedy : error.remedy());
  }
}

}  // namespace

bool is_scalar(const Given& given, const std::string& wanted, const std::string& remedy)
{
  if (given.node.kind == Node::Kind::scalar) return true;
  return given.refuse(wanted, remedy);
}

std::string alternatives(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

std::string words_as_code(const std::vector<std::string>& names)
{
  std::vector<std::string> words;
  for (const std::string& name : names) words.push_back('`' + name + '`');
  return alternatives(words);
}

std::optional<std::size_t> read_word(const Given& given, const std::vector<std::string>& names)
{
  if (!is_scalar(given, "must be " + alternatives(names))) return std::nullopt;
  const auto found = std::ranges::find(names, given.node.scalar);
  if (found != names.end()) return std::size_t(found - names.begin());
  std::string near;
  if (const auto name = nearest_name(given.node.scalar, names))
    near = "; did you mean '" + *name + "'?";
  given.refuse("must be " + alternatives(names) + near);
  return std::nullopt;
}

bool Value<double>::read(const Given& given, const Rule& rule, double& value)
{
  double number = 0;
  if (!read_number(given, rule, number) || !within(given, rule.bound, number)) return false;
  value = number;
  return true;
}

Node Value<double>::write(const double& value, const Rule& rule)
{
  return Node::of(in_readable_unit(value, rule.quantity));
}

std::string Value<double>::describe(const Rule& rule)
{
  std::string text(noun(rule.quantity));
  if (rule.quantity != Quantity::number) text += fmt::format(", e.g. `{}`", example(rule.quantity));
  if (const std::string range = rule.bound.text(); !range.empty()) text += "; " + range;
  return text;
}

bool Value<long>::read(const Given& given, const Rule& rule, long& value)
{
  double number = 0;
  if (!is_scalar(given, "must be a whole number") ||
      !read_number(given, {Quantity::number, rule.bound}, number))
    return false;
  constexpr double largest = 9007199254740992;  // 2^53: above, doubles skip whole numbers
  if (number != std::floor(number) || std::abs(number) > largest)
    return given.refuse("must be a whole number");
  if (!within(given, rule.bound, number)) return false;
  value = static_cast<long>(number);
  return true;
}

std::string Value<long>::describe(const Rule& rule)
{
  const std::string range = rule.bound.text();
  return range.empty() ? "a whole number" : "a whole number; " + range;
}

bool Value<int>::read(const Given& given, const Rule& rule, int& value)
{
  long number = 0;
  if (!Value<long>::read(given, rule, number)) return false;
  if (std::abs(number) > std::numeric_limits<int>::max())
    return given.refuse(fmt::format("must be at most {}", std::numeric_limits<int>::max()));
  value = static_cast<int>(number);
  return true;
}

bool Value<bool>::read(const Given& given, const Rule&, bool& value)
{
  if (!is_scalar(given, "must be true or false")) return false;
  const std::string& word = given.node.scalar;
  const bool yes = word == "true" || word == "yes" || word == "on";
  const bool no = word == "false" || word == "no" || word == "off";
  if (!yes && !no) return given.refuse("must be true or false");
  value = yes;
  return true;
}

bool Value<std::string>::read(const Given& given, const Rule&, std::string& value)
{
  if (!is_scalar(given, "must be a text")) return false;
  value = given.node.scalar;
  return true;
}

bool Value<std::filesystem::path>::read(const Given& given, const Rule&,
                                        std::filesystem::path& value)
{
  if (!is_scalar(given, "must be a file name")) return false;
  if (given.node.scalar.empty()) return given.refuse("must be a file name");
  value = given.node.scalar;
  return true;
}

}  // namespace mpm::scene
