/// Prints modulus, onset of buckling and onset of densification of a measured or computed curve.

#include <mpm/analysis/compression_curve.hpp>
#include <mpm/analysis/compression_summary.hpp>
#include <mpm/core/error.hpp>
#include <mpm/core/terminal.hpp>
#include <mpm/core/units.hpp>
#include <mpm/output/history.hpp>
#include <mpm/output/summary.hpp>

#include <algorithm>
#include <cstdio>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace {

using mpm::InputError;
using mpm::Quantity;
using mpm::analysis::CompressionProperties;
using mpm::analysis::CurveOptions;
using mpm::analysis::CurvePoint;
using mpm::output::HistoryTable;

struct Request {
  std::string file;
  std::string strain_column = "strain";
  std::string stress_column = "stress";
  std::string discard = "0";
  std::string ringing = "0.4 %";
  std::pair<double, double> densification_line = {CurveOptions{}.densification_from,
                                                  CurveOptions{}.densification_to};
  std::string json;
};

double strain_of(const std::string& text, const std::string& option)
{
  try {
    return mpm::to_si(text, Quantity::fraction);
  } catch (const mpm::UnitError& error) {
    throw InputError(fmt::format("{} {}: {}. {}", option, text, error.what(), error.remedy()));
  }
}

/// A column in SI units, by the unit in its title; without one it is taken to be in SI already.
std::vector<double> column_in_si(const HistoryTable& table, const std::string& name,
                                 Quantity quantity, const std::string& file)
try {
  std::vector<double> values = table[name];
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const auto& entry) { return entry.name == name; });
  if (column->unit.empty() || column->unit == "1") return values;
  const double factor = mpm::to_si("1 " + column->unit, quantity);
  for (double& value : values) value *= factor;
  return values;
} catch (const mpm::UnitError& error) {
  throw InputError(
      fmt::format("{}:1: column '{}': {}. {}", file, name, error.what(), error.remedy()));
}

/// Whether a run has written these stresses: means since the line before.
bool are_means(const HistoryTable& table, const Request& request)
{
  return table.has("energy_error") && request.strain_column == "strain" &&
         request.stress_column.starts_with("stress");
}

void print_point(const char* name, const std::optional<CurvePoint>& point)
{
  if (!point)
    fmt::print("{:24}-\n", name);
  else
    fmt::print("{:24}{:.1f} +- {:.1f} MPa at {:.2f} +- {:.2f} % strain\n", name,
               point->stress / 1e6, point->stress_error / 1e6, 100 * point->strain,
               100 * point->strain_error);
}

void print_table(const CompressionProperties& properties)
{
  if (properties.modulus)
    fmt::print("{:24}{:.0f} +- {:.0f} MPa, line through {:.1f} MPa at zero strain\n", "modulus E",
               *properties.modulus / 1e6, properties.modulus_error / 1e6,
               properties.elastic_intercept / 1e6);
  else
    fmt::print("{:24}-\n", "modulus E");
  if (properties.toe)
    fmt::print("{:24}{:.0f} MPa from {:.2f} % strain on, where that line has no stress\n",
               "modulus beyond the toe", properties.toe->modulus / 1e6,
               100 * properties.toe->strain);
  print_point("onset of buckling", properties.buckling);
  print_point("onset of densification", properties.densification);
  print_point("best energy efficiency", properties.energy_efficiency);
  if (!properties.remark.empty()) fmt::print("{:24}{}\n", "remark", properties.remark);
}

void run(const Request& request)
{
  CurveOptions options;
  options.discard_strain = strain_of(request.discard, "--discard");
  options.ringing_strain = strain_of(request.ringing, "--ringing");
  if (!(options.ringing_strain > 0))
    throw InputError(fmt::format("--ringing is {} (must be above 0).", request.ringing));
  const auto [from, to] = request.densification_line;
  if (!(from > 1 && to > from))
    throw InputError(fmt::format(
        "--densification-line is {:g} {:g} (must be two rising numbers above 1).", from, to));
  options.densification_from = from;
  options.densification_to = to;
  const HistoryTable table = mpm::output::read_history(request.file);
  std::vector<double> strain =
      column_in_si(table, request.strain_column, Quantity::fraction, request.file);
  const bool means = are_means(table, request);
  if (means) strain = mpm::analysis::middle_strains(strain);
  const std::vector<double> stress =
      column_in_si(table, request.stress_column, Quantity::pressure, request.file);
  const CompressionProperties properties = compression_properties(strain, stress, options);

  fmt::print("{}: {} over {}, {} lines{}\n", request.file, request.stress_column,
             request.strain_column, strain.size(), means ? ", means since the line before" : "");
  print_table(properties);
  if (!request.json.empty()) {
    mpm::output::Summary summary;
    summary.set("history", request.file);
    summary.set("stress_column", request.stress_column);
    describe(properties, summary.section("compression"));
    summary.write(request.json);
  }
}

int report(const std::exception& error, mpm::ExitStatus status)
{
  mpm::print_message(fmt::format("mpm_curve: {}", error.what()));
  return int(status);
}

}  // namespace

int main(int argc, char** argv)
{
  Request request;
  CLI::App app(
      "Modulus, onset of buckling and onset of densification of a compression curve.\n"
      "+- is two standard deviations over resampled noise.",
      "mpm_curve");
  app.add_option("history", request.file, "CSV file with a header line, as runs write it")
      ->required();
  app.add_option("--strain-column", request.strain_column, "compressive strain, positive")
      ->capture_default_str();
  app.add_option("--stress-column", request.stress_column, "compressive stress, positive")
      ->capture_default_str();
  app.add_option("--discard", request.discard,
                 "leave out smaller strains, such as '0.6 %': the\nstart-up transient lasts "
                 "2 x piston speed / wave\nspeed")
      ->capture_default_str();
  app.add_option("--ringing", request.ringing, "strain of one period of the curve's ringing")
      ->capture_default_str();
  app.add_option("--densification-line", request.densification_line,
                 "the line that rises from the plateau goes through\nthe points at so many times "
                 "its last stress (2 4)")
      ->type_name("FROM TO")
      ->capture_default_str();
  app.add_option("--json", request.json, "write the properties to this file as well");
  try {
    app.parse(argc, argv);
    run(request);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : int(mpm::ExitStatus::bad_input);
  } catch (const InputError& error) {
    return report(error, mpm::ExitStatus::bad_input);
  } catch (const mpm::FileError& error) {
    return report(error, mpm::ExitStatus::file_failure);
  }
  return int(mpm::ExitStatus::done);
}
