// The JSON schema of values. To mpm_par every scalar is text, to an editor `10` is a number.
#include <mpm/scene/value.hpp>

#include <fmt/format.h>

namespace mpm::scene {

namespace {

constexpr std::string_view unsigned_number = R"((\d+\.?\d*|\.\d+)([eE][+-]?\d+)?)";
// A unit begins with no digit, but for a one over a unit (`1/s`).
constexpr std::string_view unit = R"(\s*(1/)?[^\s\d.,+-].*)";

/// A regular expression of numbers on the right side of a bound's lower end, as far as signs go.
std::string number_pattern(const Bound& bound)
{
  const bool positive = bound.lower && bound.lower->value >= 0;
  const std::string number(unsigned_number);
  if (!positive) return R"(\s*\+?-?)" + number;
  if (bound.lower->included) return R"(\s*\+?(-(?=[0.]+([^\d.]|$)))?)" + number;
  return R"(\s*\+?(?=[\d.]*[1-9]))" + number;
}

void add_ends(Json& schema, const Bound& bound)
{
  if (bound.lower)
    schema[bound.lower->included ? "minimum" : "exclusiveMinimum"] = bound.lower->value;
  if (bound.upper)
    schema[bound.upper->included ? "maximum" : "exclusiveMaximum"] = bound.upper->value;
}

/// What editors show in place of the pattern.
std::string wanted(const std::string& what, const Bound& bound)
{
  const std::string range = bound.text();
  return "must be " + what + (range.empty() ? "" : ", " + range);
}

Json plain_number(std::string_view type, const std::string& what, const Rule& rule,
                  std::string_view end)
{
  Json schema;
  schema["type"] = {type, "string"};
  schema["pattern"] = fmt::format("^{}{}$", number_pattern(rule.bound), end);
  schema["patternErrorMessage"] = wanted(what, rule.bound);
  add_ends(schema, rule.bound);
  return schema;
}

Json text_schema()
{
  Json schema;
  schema["type"] = {"string", "number", "boolean"};
  return schema;
}

/// Rows of a time and so many values.
Json rows_schema(const Rule& rule, std::size_t least, std::size_t most)
{
  Json row;
  row["type"] = "array";
  row["items"] = Json::array({Value<double>::schema({Quantity::time})});
  row["additionalItems"] = Value<double>::schema(rule);
  row["minItems"] = 1 + least;
  row["maxItems"] = 1 + most;
  return list_schema(row, 2);
}

}  // namespace

Json words_schema(const std::vector<std::string>& words, const std::vector<std::string>& helps)
{
  Json schema;
  Json& list = schema["enum"] = Json::array();
  for (const std::string& word : words) {
    const auto number = split_number_and_unit(word);
    if (number && number->unit.empty()) list.push_back(static_cast<long>(number->number));
    list.push_back(word);
  }
  if (!helps.empty()) schema["enumDescriptions"] = helps;
  return schema;
}

Json list_schema(Json items, std::size_t least, std::size_t most)
{
  Json schema;
  schema["type"] = "array";
  schema["items"] = std::move(items);
  if (least > 0) schema["minItems"] = least;
  if (most > 0) schema["maxItems"] = most;
  return schema;
}

Json one_or_list(const Rule& rule, Json one, Json list)
{
  if (!rule.spread) return list;
  Json schema;
  schema["anyOf"] = Json::array({std::move(one), std::move(list)});
  return schema;
}

Json Value<double>::schema(const Rule& rule)
{
  const std::string what(noun(rule.quantity));
  if (rule.quantity == Quantity::number) return plain_number("number", what, rule, R"(\s*)");
  if (rule.quantity == Quantity::fraction) {
    Json schema = plain_number("number", what + " such as 0.6 or 60 %", rule, R"(\s*%?\s*)");
    schema["examples"] = {"60 %"};
    return schema;
  }
  const std::string such(example(rule.quantity));
  Json schema;
  schema["type"] = "string";
  schema["pattern"] = fmt::format("^{}{}$", number_pattern(rule.bound), unit);
  schema["patternErrorMessage"] = wanted(what + " with its unit, such as " + such, rule.bound);
  schema["examples"] = {such};
  return schema;
}

Json Value<long>::schema(const Rule& rule)
{
  return plain_number("integer", "a whole number", rule, R"(\s*)");
}

Json Value<bool>::schema(const Rule&)
{
  Json schema;
  schema["enum"] = {true, false, "true", "false", "yes", "no", "on", "off"};
  return schema;
}

Json Value<std::string>::schema(const Rule&)
{
  return text_schema();
}

Json Value<std::filesystem::path>::schema(const Rule&)
{
  Json schema = text_schema();
  schema["minLength"] = 1;
  return schema;
}

Json Value<Formula>::schema(const Rule& rule)
{
  Json schema = text_schema();
  schema["examples"] = {std::string(example(rule.quantity))};
  return schema;
}

Json Value<Definitions>::schema(const Rule&)
{
  Json schema;
  schema["type"] = "object";
  schema["additionalProperties"] = text_schema();
  return schema;
}

Json Value<TimeTable>::schema(const Rule& rule)
{
  return rows_schema(rule, 2, 3);
}

Json Value<MotionTable>::schema(const Rule& rule)
{
  return rows_schema(rule, 1, 1);
}

}  // namespace mpm::scene
