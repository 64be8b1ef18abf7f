#include <mpm/core/error.hpp>
#include <mpm/output/history.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <sys/resource.h>

namespace mpm::output {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::filesystem::path scratch(const std::string& name)
{
  return std::filesystem::path(::testing::TempDir()) / ("history_test_" + name);
}

std::string text_of(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::filesystem::path file_with(const std::string& name, const std::string& text)
{
  std::ofstream(scratch(name)) << text;
  return scratch(name);
}

template <class Error, class Action>
std::string message_of(Action&& action)
{
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(History, HeaderNamesColumnsWithUnitsAndEveryLineIsOnDiskAtOnce)
{
  HistoryFile history(scratch("live.csv"), {{"strain", "1"}, {"stress", "Pa"}});
  EXPECT_EQ(text_of(scratch("live.csv")), "strain [1],stress [Pa]\n");
  history.append(std::vector{0.25, -1.5e8});
  EXPECT_EQ(text_of(scratch("live.csv")), "strain [1],stress [Pa]\n0.25,-150000000\n");
}

TEST(History, ComesBackWithTwelveDigitsIncludingNotANumber)
{
  const double third = 1.0 / 3;
  {
    HistoryFile history(scratch("round.csv"), {{"time", "s"}, {"stress_piston", "Pa"}});
    history.append(std::vector{third * 1e-9, std::nan("")});
    history.append(std::vector{0.0, -third * 1e12});
  }
  const HistoryTable table = read_history(scratch("round.csv"));
  EXPECT_EQ(table.columns[1].name, "stress_piston");
  EXPECT_EQ(table.columns[1].unit, "Pa");
  EXPECT_NEAR(table["time"][0], third * 1e-9, 1e-12 * 1e-9);  // half a unit of the 12th digit
  EXPECT_NEAR(table["stress_piston"][1], -third * 1e12, 1);
  EXPECT_TRUE(std::isnan(table["stress_piston"][0]));
  EXPECT_TRUE(table.has("time"));
  EXPECT_FALSE(table.has("time [s]"));
}

TEST(History, ReadsWhatSpreadsheetsWrite)
{
  const auto file = file_with(
      "sheet.csv", "\xEF\xBB\xBF\"strain [%]\" , stress\r\n 1.5, +2e3\r\n\r\n2.5 ,3000\r\n");
  const HistoryTable table = read_history(file);
  EXPECT_EQ(table.columns[0].unit, "%");
  EXPECT_EQ(table.columns[1].unit, "");
  EXPECT_THAT(table["strain"], ElementsAre(1.5, 2.5));
  EXPECT_THAT(table["stress"], ElementsAre(2000, 3000));
}

TEST(History, CellsWithoutNumbersAreInNobodysWayUntilTheirColumnIsAskedFor)
{
  const HistoryTable table = read_history(file_with(
      "laboratory.csv", "strain [1],stress [Pa],note\n0,,\"wet, but whole\"\n0.1,2e6,\n"));
  EXPECT_THAT(table["strain"], ElementsAre(0, 0.1));
  EXPECT_TRUE(std::isnan(table["stress"][0]));
  EXPECT_EQ(table["stress"][1], 2e6);
  EXPECT_THAT(message_of<InputError>([&] { table["note"]; }),
              HasSubstr("laboratory.csv:2: 'wet, but whole' in column 'note' is not a number"));
}

TEST(History, WrongLineIsNamedByFileAndNumber)
{
  const HistoryTable words =
      read_history(file_with("words.csv", "strain [1],stress [Pa]\n0,0\n0.1,much\n0.2,more\n"));
  EXPECT_THAT(words["strain"], ElementsAre(0, 0.1, 0.2));
  EXPECT_THAT(message_of<InputError>([&] { words["stress"]; }),
              HasSubstr("words.csv:3: 'much' in column 'stress' is not a number"));
  const auto cut = file_with("cut.csv", "strain [1],stress [Pa]\n0,0\n0.1\n");
  EXPECT_THAT(message_of<InputError>([&] { read_history(cut); }),
              HasSubstr("cut.csv:3: the line has 1 values (the header has 2 columns)"));
  EXPECT_THAT(message_of<InputError>([&] { read_history(scratch("no such file")); }),
              HasSubstr("cannot be read"));
}

TEST(History, UnknownColumnIsAnsweredWithTheKnownOnes)
{
  const HistoryTable table = read_history(file_with("known.csv", "strain [1],stress [Pa]\n0,0\n"));
  EXPECT_THAT(message_of<InputError>([&] { table["strian"]; }),
              HasSubstr("known.csv:1: there is no column 'strian' (there are: strain, stress)"));
}

TEST(History, LinesThatHaveNotBeenAreCutAndOthersTakeTheirPlace)
{
  HistoryFile history(scratch("cut_back.csv"), {{"time", "s"}});
  for (const double time : {1.0, 2.0, 3.25, 4.0}) history.append(std::vector{time});
  history.cut(2);
  EXPECT_EQ(text_of(scratch("cut_back.csv")), "time [s]\n1\n2\n");
  history.append(std::vector{2.5});
  EXPECT_EQ(text_of(scratch("cut_back.csv")), "time [s]\n1\n2\n2.5\n");
  history.cut(0);
  EXPECT_EQ(text_of(scratch("cut_back.csv")), "time [s]\n");
}

TEST(History, DirectoryThatIsAFileIsAFileError)
{
  const auto file = file_with("a_file", "x");
  EXPECT_THAT(message_of<FileError>([&] {
                HistoryFile(file / "h.csv", {{"time", "s"}});
              }),
              HasSubstr("Not a directory"));
}

TEST(History, FullDiskIsAnErrorAndLeavesWholeLines)
{
  const auto full = [] { HistoryFile("/dev/full", {{"time", "s"}}); };
  EXPECT_THAT(message_of<FileError>(full), HasSubstr("No space left on device"));

  HistoryFile history(scratch("full.csv"), {{"time", "s"}, {"stress", "Pa"}});
  history.append(std::vector{1.0, 2.0});
  const std::string before = text_of(scratch("full.csv"));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit small = old;
  small.rlim_cur = before.size() + 3;  // room for a part of the next line
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of<FileError>([&] {
    history.append(std::vector{3.14159, 2.71828});
  });
  setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_THAT(message, HasSubstr("full.csv: cannot write a line"));
  EXPECT_EQ(text_of(scratch("full.csv")), before);
}

}  // namespace
}  // namespace mpm::output
