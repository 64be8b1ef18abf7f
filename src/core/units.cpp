#include <mpm/core/error.hpp>
#include <mpm/core/nearest_name.hpp>
#include <mpm/core/units.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <udunits2.h>

namespace mpm {

namespace {

struct QuantityRow {
  Quantity quantity;
  std::string_view noun, si_unit, example;
  std::vector<std::string> customary;  ///< offered in messages
  std::size_t written;                 ///< so many of them are used for writing
};

const QuantityRow& row(Quantity quantity)
{
  using enum Quantity;
  static const std::vector<QuantityRow> rows{
      {number, "a number", "", "10", {}, 0},
      {fraction, "a fraction", "", "0.6 or 60 %", {}, 0},
      {length, "a length", "m", "0.832 mm", {"mm", "um", "m", "nm", "cm", "µm"}, 4},
      {time, "a time", "s", "1 us", {"s", "ms", "us", "ns", "µs"}, 4},
      {velocity, "a velocity", "m/s", "10 m/s", {"m/s", "mm/s", "km/s"}, 1},
      {pressure, "a pressure", "Pa", "10.6 GPa", {"MPa", "GPa", "kPa", "Pa", "N/mm^2"}, 4},
      {density, "a density", "kg/m^3", "1500 kg/m^3", {"kg/m^3", "g/cm^3"}, 1},
      {angle, "an angle", "rad", "30 deg", {"deg", "rad", "degree", "radian", "°"}, 1},
      {acceleration, "an acceleration", "m/s^2", "9.81 m/s^2", {"m/s^2", "mm/us^2"}, 1},
      {rate, "a rate", "1/s", "1000 1/s", {"1/s", "1/ms", "1/us"}, 1}};
  return rows[static_cast<std::size_t>(quantity)];
}

constexpr std::array dimensional{Quantity::length,   Quantity::time,        Quantity::velocity,
                                 Quantity::pressure, Quantity::density,     Quantity::angle,
                                 Quantity::rate,     Quantity::acceleration};

std::string_view trimmed(std::string_view text)
{
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

using UnitHandle = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using ConverterHandle = std::unique_ptr<cv_converter, decltype(&cv_free)>;

UnitHandle parse(ut_system* system, const std::string& name)
{
  return {ut_parse(system, name == "deg" ? "degree" : name.c_str(), UT_UTF8), &ut_free};
}

/// A unit text with a number of its own (`10 MPa`, `MPa 3`) would silently multiply the value;
/// digits are exponents (`m3`, `m^-3`, `s-1`) or refused, but for a one over a unit (`1/s`).
bool has_factor(std::string_view unit)
{
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  char before = ' ';
  for (const char c : unit) {
    const bool digit = c >= '0' && c <= '9';
    const bool exponent_sign = c == '-' || c == '+';
    if (digit && (before == ' ' || before == '/' || before == '.' || before == '(')) return true;
    if (c == '@' || (exponent_sign && before == ' ')) return true;
    before = c;
  }
  return false;
}

/// The decimal number `digits` times 10^shift, rounded once: 0.832 mm is the double 0.832e-3.
double shifted(std::string_view digits, int shift)
{
  const auto e = digits.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view written = digits.substr(e + 1);
    if (written.starts_with('+')) written.remove_prefix(1);
    std::from_chars(written.data(), written.data() + written.size(), exponent);
  }
  const std::string text = fmt::format("{}e{}", digits.substr(0, e), exponent + shift);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::result_out_of_range) {
    throw UnitError("lies outside the range of numbers", "Give a smaller or larger one");
  }
  return value;
}

}  // namespace

std::string_view noun(Quantity quantity)
{
  return row(quantity).noun;
}
std::string_view example(Quantity quantity)
{
  return row(quantity).example;
}
std::string_view si_unit(Quantity quantity)
{
  return row(quantity).si_unit;
}

std::optional<Measure> split_number_and_unit(std::string_view text)
{
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Measure measure{};
  const auto [end, status] =
      std::from_chars(text.data(), text.data() + text.size(), measure.number);
  if (status != std::errc{} || !std::isfinite(measure.number)) return std::nullopt;
  measure.digits = text.substr(0, static_cast<std::size_t>(end - text.data()));
  measure.unit = trimmed(text.substr(measure.digits.size()));
  return measure;
}

UnitTable::UnitTable(const char* xml_file)
{
  ut_set_error_message_handler(&ut_ignore);  // it would print beside our own message
  system_ = ut_read_xml(xml_file);
  if (system_ == nullptr) {
    ut_status status = UT_SUCCESS;
    throw FileError(fmt::format(
        "{}: cannot read the table of units (udunits2). Install package libudunits2-data, or set "
        "UDUNITS2_XML_PATH to the file udunits2.xml.",
        ut_get_path_xml(xml_file, &status)));
  }
}

UnitTable::~UnitTable()
{
  ut_free_system(system_);
}

std::optional<double> UnitTable::factor(const std::string& unit, Quantity quantity) const
{
  const UnitHandle from = parse(system_, unit);
  const UnitHandle to = parse(system_, std::string(si_unit(quantity)));
  if (!from || !to) return std::nullopt;
  const ConverterHandle converter{ut_get_converter(from.get(), to.get()), &cv_free};
  if (!converter) return std::nullopt;
  // The library also converts reciprocals (Hz to s) and scales with an offset: neither maps 0 to 0.
  if (cv_convert_double(converter.get(), 0.0) != 0.0) return std::nullopt;
  const double factor = cv_convert_double(converter.get(), 1.0);
  // To the library an angle is a plain number, so `30 %` would be one.
  if (quantity == Quantity::angle && unit.find('%') != std::string::npos) return std::nullopt;
  return factor;
}

void UnitTable::explain(const std::string& unit, Quantity quantity) const
{
  const std::string remedy = fmt::format("Write e.g. {}", example(quantity));
  if (unit.find(',') == 0) throw UnitError("the decimal sign is a point, not a comma", remedy);
  if (has_factor(unit))
    throw UnitError(fmt::format("'{}' is not a unit: a value has one number", unit), remedy);
  for (const Quantity other : dimensional) {
    if (other != quantity && factor(unit, other))
      throw UnitError(fmt::format("{} is {}, not {}", unit, noun(other), noun(quantity)), remedy);
  }
  if (parse(system_, unit))
    throw UnitError(fmt::format("{} is not {}", unit, noun(quantity)), remedy);
  std::string near;
  if (const auto name = nearest_name(unit, row(quantity).customary))
    near = fmt::format(", did you mean '{}'?", *name);
  throw UnitError(fmt::format("unknown unit '{}'{}", unit, near), remedy);
}

double UnitTable::to_si(std::string_view text, Quantity quantity) const
{
  const std::string remedy = fmt::format("Write e.g. {}", example(quantity));
  const auto measure = split_number_and_unit(text);
  if (!measure) throw UnitError(fmt::format("must be {}", noun(quantity)), remedy);

  const std::string unit(measure->unit);
  if (quantity == Quantity::number) {
    if (!unit.empty()) throw UnitError("takes no unit", remedy);
    return measure->number;
  }
  if (quantity == Quantity::fraction) {
    if (unit == "%") return shifted(measure->digits, -2);
    if (!unit.empty()) throw UnitError("a fraction takes no unit but %", remedy);
    return measure->number;
  }
  if (unit.empty()) throw UnitError(fmt::format("{} needs a unit", noun(quantity)), remedy);
  const std::optional<double> scale = has_factor(unit) ? std::nullopt : factor(unit, quantity);
  if (!scale) explain(unit, quantity);

  const double exponent = std::round(std::log10(*scale));
  const bool power_of_ten = std::abs(*scale / std::pow(10.0, exponent) - 1) < 1e-13;
  return power_of_ten ? shifted(measure->digits, static_cast<int>(exponent))
                      : measure->number * *scale;
}

double to_si(std::string_view text, Quantity quantity)
{
  static const UnitTable table;
  return table.to_si(text, quantity);
}

std::string in_readable_unit(double value, Quantity quantity)
{
  if (si_unit(quantity).empty()) return fmt::format("{}", value);
  if (value == 0) return fmt::format("0 {}", si_unit(quantity));
  std::string best = fmt::format("{} {}", value, si_unit(quantity));
  for (std::size_t u = 0; u < row(quantity).written; ++u) {
    const std::string& unit = row(quantity).customary[u];
    const double number = value / to_si("1 " + unit, quantity);
    // Twelve digits first: the quotient is seldom the number somebody wrote.
    for (const std::string& text :
         {fmt::format("{:.12g} {}", number, unit), fmt::format("{} {}", number, unit)}) {
      if (text.size() < best.size() && to_si(text, quantity) == value) best = text;
    }
  }
  return best;
}

}  // namespace mpm
