#include <mpm/core/error.hpp>
#include <mpm/output/replace_file.hpp>
#include <mpm/output/summary.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace mpm::output {
namespace {

std::filesystem::path scratch(const std::string& name)
{
  return std::filesystem::path(::testing::TempDir()) / ("summary_test_" + name);
}

TEST(Summary, KeepsOrderTypesAndNesting)
{
  Summary summary;
  summary.set("name", "radial");
  summary.set("particles", std::size_t{35352});
  summary.set("finished", true);
  summary.section("compression").set("modulus", 2.74e9);
  summary.section("compression").section("buckling").set("strain", 0.018);
  summary.set("shares", std::vector{0.25, 0.75});
  const auto json = nlohmann::ordered_json::parse(summary.text());
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys,
              ::testing::ElementsAre("name", "particles", "finished", "compression", "shares"));
  EXPECT_EQ(json["name"], "radial");
  EXPECT_TRUE(json["particles"].is_number_integer());
  EXPECT_EQ(json["particles"], 35352);
  EXPECT_EQ(json["finished"], true);
  EXPECT_EQ(json["compression"]["modulus"], 2.74e9);
  EXPECT_EQ(json["compression"]["buckling"]["strain"], 0.018);
  EXPECT_EQ(json["shares"][1], 0.75);
}

TEST(Summary, WhatIsNoNumberBecomesNull)
{
  Summary summary;
  summary.set("nan", std::nan(""));
  summary.set("infinite", std::numeric_limits<double>::infinity());
  summary.set("absent", std::optional<double>());
  summary.set("present", std::optional<double>(1.5));
  summary.set("list", std::vector{1.0, std::nan("")});
  const auto json = nlohmann::json::parse(summary.text());
  EXPECT_TRUE(json["nan"].is_null());
  EXPECT_TRUE(json["infinite"].is_null());
  EXPECT_TRUE(json["absent"].is_null());
  EXPECT_EQ(json["present"], 1.5);
  EXPECT_TRUE(json["list"][1].is_null());
}

TEST(Summary, SettingAKeyAgainReplacesItsValueInPlace)
{
  Summary summary;
  summary.set("step", 1);
  summary.set("name", "a");
  summary.set("step", 2);
  EXPECT_EQ(summary.text(), "{\n  \"step\": 2,\n  \"name\": \"a\"\n}");
}

TEST(Summary, BytesThatAreNotUtf8DoNotStopTheFile)
{
  Summary summary;
  summary.set("path", "caf\xE9");
  EXPECT_TRUE(nlohmann::json::parse(summary.text())["path"].is_string());
}

TEST(Summary, IsThereWholeAndLeavesNoTemporaryFile)
{
  const auto file = scratch("whole.json");
  Summary summary;
  summary.set("step", 7);
  summary.write(file);
  std::ifstream stream(file);
  EXPECT_EQ(nlohmann::json::parse(stream)["step"], 7);
  EXPECT_FALSE(std::filesystem::exists(temporary_name(file)));
}

TEST(Summary, FailureKeepsTheOldFileAndNamesTheReason)
{
  const auto file = scratch("kept.json");
  std::filesystem::remove(temporary_name(file));
  replace_file(file, "old");
  std::filesystem::create_symlink("/dev/full", temporary_name(file));  // every write finds no space
  try {
    replace_file(file, "new");
    ADD_FAILURE() << "a full disk went unnoticed";
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("No space left on device"));
  }
  std::ifstream stream(file);
  std::string text;
  std::getline(stream, text);
  EXPECT_EQ(text, "old");
  EXPECT_FALSE(std::filesystem::is_symlink(temporary_name(file)));
}

}  // namespace
}  // namespace mpm::output
