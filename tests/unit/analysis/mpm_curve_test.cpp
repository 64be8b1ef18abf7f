#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "synthetic_curve.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace mpm::analysis {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int status;
  std::string text;  ///< both streams
};

Outcome run(const std::string& arguments)
{
  FILE* pipe = popen((std::string("'") + MPM_CURVE + "' " + arguments + " 2>&1").c_str(), "r");
  Outcome outcome{-1, ""};
  std::array<char, 256> piece{};
  while (std::fgets(piece.data(), int(piece.size()), pipe)) outcome.text += piece.data();
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

std::string scratch(const std::string& name)
{
  return (std::filesystem::path(::testing::TempDir()) / ("mpm_curve_test_" + name)).string();
}

std::string wood_history(const std::string& header, double strain_unit, double stress_unit)
{
  const std::string file = scratch("wood.csv");
  std::ofstream stream(file);
  stream << header << '\n';
  for (int i = 0; i <= 3000; ++i) {
    const double strain = 0.0002 * i;
    stream << strain / strain_unit << ',' << synthetic::wood(strain) / stress_unit << '\n';
  }
  return file;
}

TEST(MpmCurve, PrintsTheTableOfARunAndWritesItAsJson)
{
  const std::string file = wood_history("strain [1],stress [Pa]", 1, 1);
  const Outcome outcome = run(file + " --json " + scratch("wood.json"));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.text, HasSubstr("onset of buckling       54.4"));
  std::ifstream stream(scratch("wood.json"));
  const auto json = nlohmann::json::parse(stream);
  EXPECT_NEAR(json["compression"]["modulus"].get<double>(), 2740e6, 0.03 * 2740e6);
  EXPECT_NEAR(json["compression"]["densification"]["strain"].get<double>(), 0.280, 0.002);
}

/// As runs write it: stresses are means since the line before.
std::string history_of_means(int lines, const char* last_column)
{
  const std::string file = scratch("means.csv");
  std::ofstream stream(file);
  stream << "strain [1],stress [Pa]," << last_column << "\n0,0,0\n";
  constexpr int parts = 100;
  const double width = 0.6 / lines;
  for (int i = 1; i <= lines; ++i) {
    double sum = 0;
    for (int k = 0; k < parts; ++k) sum += synthetic::wood(width * (i - 1 + (k + 0.5) / parts));
    stream << width * i << ',' << sum / parts << ",0\n";
  }
  return file;
}

double onset_of_densification(const std::string& file, const std::string& words)
{
  const Outcome outcome = run(file + " --json " + scratch("onset.json"));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(words));
  std::ifstream stream(scratch("onset.json"));
  const auto json = nlohmann::json::parse(stream);
  return json["compression"]["densification"]["strain"].get<double>();
}

TEST(MpmCurve, CountsMeansOfRunsAtTheMiddleOfTheirLines)
{
  const double onset =
      onset_of_densification(wood_history("strain [1],stress [Pa]", 1, 1), "3001 lines\n");
  constexpr double line = 0.6 / 600;
  const std::string of_run = history_of_means(600, "energy_error [1]");
  EXPECT_NEAR(onset_of_densification(of_run, "601 lines, means since the line before\n"), onset,
              0.2 * line);
  const std::string of_laboratory = history_of_means(600, "force [N]");
  EXPECT_NEAR(onset_of_densification(of_laboratory, "601 lines\n"), onset + 0.5 * line, 0.2 * line);
}

TEST(MpmCurve, ConvertsTheUnitsOfALaboratoryTable)
{
  const std::string file = wood_history("epsilon [%],sigma [MPa]", 0.01, 1e6);
  const Outcome outcome =
      run(file + " --strain-column epsilon --stress-column sigma --discard '0.1 %'");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.text, HasSubstr("onset of buckling       54.4"));
}

TEST(MpmCurve, PassesOverWhatALaboratoryDidNotMeasure)
{
  const std::string file = scratch("gaps.csv");
  std::ofstream stream(file);
  stream << "specimen,strain [%],stress [MPa],remark\n";
  for (int i = 0; i <= 3000; ++i) {
    const double strain = 0.0002 * i;
    stream << "P7," << 100 * strain << ',';
    if (i % 7 != 3) stream << synthetic::wood(strain) / 1e6;
    stream << (i == 1200 ? ",\"cracks, at the edge\"\n" : ",\n");
  }
  stream.close();
  const Outcome outcome = run(file);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("onset of buckling       54."));
  const Outcome words = run(file + " --stress-column remark");
  EXPECT_EQ(words.status, 2);
  EXPECT_THAT(words.text, HasSubstr("gaps.csv:1202: 'cracks, at the edge' in column 'remark'"));
}

TEST(MpmCurve, DrawsTheLineOfDensificationWhereItIsAskedFor)
{
  const std::string file = wood_history("strain [1],stress [Pa]", 1, 1);
  EXPECT_THAT(run(file).text, HasSubstr(" at 27.9"));
  EXPECT_THAT(run(file + " --densification-line 4 8").text, HasSubstr(" at 29."));
  for (const char* wrong : {"4 4", "4 2", "1 2", "nan 3"}) {
    const Outcome refused = run(file + " --densification-line " + wrong);
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_THAT(refused.text, HasSubstr("(must be two rising numbers above 1)")) << wrong;
  }
}

TEST(MpmCurve, BadInputIsStatusTwoWithOneClearLine)
{
  const std::string file = wood_history("strain [1],force [Pa]", 1, 1);
  const Outcome column = run(file);
  EXPECT_EQ(column.status, 2);
  EXPECT_THAT(column.text, HasSubstr(":1: there is no column 'stress' (there are: strain, force)"));
  const Outcome missing = run(std::string("'").append(scratch("not there.csv")).append("'"));
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.text, HasSubstr("cannot be read"));
  const Outcome unit = run(file + " --stress-column force --discard '3 kg'");
  EXPECT_EQ(unit.status, 2);
  EXPECT_THAT(unit.text, HasSubstr("--discard"));
  EXPECT_EQ(run("--no-such-option").status, 2);
}

}  // namespace
}  // namespace mpm::analysis
