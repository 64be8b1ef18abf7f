// Formulas, and tables of values over time.
#include <mpm/scene/value.hpp>

#include <cctype>

#include <fmt/format.h>

namespace mpm::scene {

namespace {

/// visit(row) for each row of a table, a list of a time and so many values; false once one is
/// wrong.
template <class Visit>
bool read_rows(const Given& given, std::size_t values, Visit visit)
{
  if (given.node.kind != Node::Kind::list || given.node.items.size() < 2)
    return given.refuse("must be a list of at least two entries");
  bool good = true;
  for (std::size_t i = 0; i < given.node.items.size(); ++i) {
    const Given row = given.item(i);
    if (row.node.kind != Node::Kind::list || row.node.items.size() != 1 + values)
      good = row.refuse(fmt::format("must be a list of {}: a time and {}", 1 + values,
                                    values == 1 ? "a value" : fmt::format("{} values", values)));
    else
      good &= visit(row);
  }
  return good;
}

/// The first entry of a row, later than that of the row before.
bool read_time(const Given& row, std::optional<double> before, double& time)
{
  const Given first = row.item(0);
  if (!Value<double>::read(first, {Quantity::time}, time)) return false;
  return before && time <= *before ? first.refuse("must be later than the entry before") : true;
}

Node list_with_time(double time)
{
  Node list;
  list.kind = Node::Kind::list;
  list.items.push_back(Value<double>::write(time, {Quantity::time}));
  return list;
}

std::string describe_rows(const Rule& rule, const std::string& values)
{
  return fmt::format("a list of lists: a time and {}, e.g. `{}`", values, example(rule.quantity));
}

}  // namespace

bool Value<Formula>::read(const Given& given, const Rule& rule, Formula& value)
{
  if (!is_scalar(given, "must be a formula")) return false;
  const std::string& text = given.node.scalar;
  std::optional<UnitError> no_measure;
  try {
    value = Formula(fmt::format("{}", to_si(text, rule.quantity)), rule.dimensions);
    return true;
  } catch (const UnitError& error) {
    no_measure = error;
  }
  try {
    value = Formula(text, rule.dimensions, given.definitions);
    return true;
  } catch (const FormulaError& error) {
    // `10 mm`: a number with a unit, though with a wrong one.
    const auto measure = split_number_and_unit(text);
    const bool with_unit = measure && text.find(' ') != std::string::npos &&
                           !measure->unit.empty() && std::isalpha(measure->unit.front()) &&
                           measure->unit.find_first_of("(+") == std::string::npos;
    return with_unit ? given.refuse(no_measure->what(), no_measure->remedy())
                     : given.refuse(error.what(), error.remedy());
  }
}

Node Value<Formula>::write(const Formula& value, const Rule&)
{
  return Node::of_text(value.text());
}

std::string Value<Formula>::describe(const Rule& rule)
{
  return fmt::format("a formula in SI units, or {}, e.g. `{}`", noun(rule.quantity),
                     example(rule.quantity));
}

bool Value<Definitions>::read(const Given& given, const Rule& rule, Definitions& definitions)
{
  if (given.node.kind != Node::Kind::map)
    return given.refuse("must be a map of names to formulas", "Write e.g. {c: sqrt(2e9/1500)}");
  bool good = true;
  definitions.clear();
  for (const Entry& entry : given.node.entries) {
    const Given value = given.entry(entry);
    if (!is_scalar(value, "must be a formula")) {
      good = false;
      continue;
    }
    try {
      check_name({entry.key, ""}, definitions);
      const Formula sound(entry.value.scalar, rule.dimensions, definitions);
      definitions.push_back({entry.key, entry.value.scalar});
    } catch (const FormulaError& error) {
      good = value.refuse(error.what(), error.remedy());
    }
  }
  return good;
}

Node Value<Definitions>::write(const Definitions& definitions, const Rule&)
{
  Node node;
  node.kind = definitions.empty() ? Node::Kind::nothing : Node::Kind::map;
  for (const Definition& definition : definitions)
    node.entries.push_back({definition.name, {}, Node::of_text(definition.text)});
  return node;
}

std::string Value<Definitions>::describe(const Rule&)
{
  return "a map of names to formulas in SI units, e.g. `{c: sqrt(2e9/1500)}`";
}

bool Value<TimeTable>::read(const Given& given, const Rule& rule, TimeTable& table)
{
  TimeTable inner;
  const bool good = read_rows(given, std::size_t(rule.dimensions), [&](const Given& row) {
    TimeTable::Row next{0, std::vector<double>(3)};
    bool sound = read_time(
        row, inner.empty() ? std::nullopt : std::optional(inner.rows.back().time), next.time);
    for (int d = 0; d < rule.dimensions; ++d)
      sound &= Value<double>::read(row.item(std::size_t(d) + 1), rule, next.values[std::size_t(d)]);
    inner.rows.push_back(std::move(next));
    return sound;
  });
  if (good) table = std::move(inner);
  return good;
}

Node Value<TimeTable>::write(const TimeTable& table, const Rule& rule)
{
  Node node;
  node.kind = Node::Kind::list;
  for (const TimeTable::Row& row : table.rows) {
    Node list = list_with_time(row.time);
    for (int d = 0; d < rule.dimensions; ++d)
      list.items.push_back(Value<double>::write(row.values[std::size_t(d)], rule));
    node.items.push_back(std::move(list));
  }
  return node;
}

std::string Value<TimeTable>::describe(const Rule& rule)
{
  return describe_rows(rule, "a value per axis");
}

bool Value<MotionTable>::read(const Given& given, const Rule& rule, MotionTable& table)
{
  MotionTable inner;
  const bool good = read_rows(given, 1, [&](const Given& row) {
    WallMotion::Entry next{};
    const bool sound =
        read_time(row, inner.empty() ? std::nullopt : std::optional(inner.back().time), next.time) &
        Value<double>::read(row.item(1), rule, next.velocity);
    inner.push_back(next);
    return sound;
  });
  if (good) table = std::move(inner);
  return good;
}

Node Value<MotionTable>::write(const MotionTable& table, const Rule& rule)
{
  Node node;
  node.kind = Node::Kind::list;
  for (const WallMotion::Entry& entry : table) {
    Node list = list_with_time(entry.time);
    list.items.push_back(Value<double>::write(entry.velocity, rule));
    node.items.push_back(std::move(list));
  }
  return node;
}

std::string Value<MotionTable>::describe(const Rule& rule)
{
  return describe_rows(rule, "a value");
}

}  // namespace mpm::scene
