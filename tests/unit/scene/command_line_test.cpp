#include <mpm/core/error.hpp>
#include <mpm/scene/command_line.hpp>

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Words = std::vector<std::string>;

CommandLine parsed(const Words& words)
{
  return std::get<CommandLine>(parse_command_line(words, "mpm_par 1.2.3\nPETSc 4.5\n"));
}

std::string answer(const Words& words)
{
  return std::get<Answer>(parse_command_line(words, "mpm_par 1.2.3\nPETSc 4.5\n")).text;
}

std::string refusal(const Words& words)
{
  try {
    parse_command_line(words, "mpm_par 1.2.3\nPETSc 4.5\n");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CommandLineOptions, ASceneAlone)
{
  const CommandLine line = parsed({"a.yaml"});
  EXPECT_EQ(line.scene, "a.yaml");
  EXPECT_FALSE(line.check);
  EXPECT_THAT(line.petsc, IsEmpty());
  Scene scene;
  scene.name = "oak";
  EXPECT_EQ(results_folder(line, scene), "results/oak");
}

TEST(CommandLineOptions, OursMayStandBeforeAndBehindTheScene)
{
  const CommandLine line =
      parsed({"--set", "a.b=[1, 2]", "--check", "a.yaml", "--output", "out", "--set=steps=3"});
  EXPECT_EQ(line.scene, "a.yaml");
  EXPECT_TRUE(line.check);
  EXPECT_THAT(line.overrides, ElementsAre("a.b=[1, 2]", "steps=3"));
  EXPECT_EQ(results_folder(line, Scene{}), "out");
}

TEST(CommandLineOptions, AReportIsOfARun)
{
  EXPECT_TRUE(parsed({"a.yaml", "--report"}).report);
  EXPECT_FALSE(parsed({"a.yaml"}).report);
  EXPECT_THAT(refusal({"--report", "--check", "a.yaml"}), HasSubstr("--check leaves none"));
}

TEST(CommandLineOptions, APreviewIsAPngAndBelongsToCheck)
{
  EXPECT_EQ(parsed({"--check", "--preview", "a.png", "a.yaml"}).preview, "a.png");
  EXPECT_EQ(parsed({"a.yaml", "--preview=b.png", "--check"}).preview, "b.png");
  EXPECT_FALSE(parsed({"--check", "a.yaml"}).preview);
  EXPECT_THAT(refusal({"--preview", "a.png", "a.yaml"}), HasSubstr("belongs to --check"));
  EXPECT_THAT(refusal({"--check", "--preview", "a.yaml", "b.yaml"}), HasSubstr("ends with .png"));
}

TEST(CommandLineOptions, RanksToStudyAreAListAndBelongToCheck)
{
  EXPECT_THAT(parsed({"--check", "--ranks", "8,64,512", "a.yaml"}).ranks, ElementsAre(8, 64, 512));
  EXPECT_THAT(parsed({"a.yaml", "--check", "--ranks=3"}).ranks, ElementsAre(3));
  EXPECT_THAT(refusal({"--ranks", "8", "a.yaml"}), HasSubstr("--ranks belongs to --check"));
  EXPECT_THAT(refusal({"--check", "--ranks", "0", "a.yaml"}), HasSubstr("--ranks"));
}

TEST(CommandLineOptions, ARunGoesOnFromTheNewestCheckpointOrFromAFile)
{
  const CommandLine newest = parsed({"--restart", "a.yaml"});
  EXPECT_TRUE(newest.restart);
  EXPECT_FALSE(newest.checkpoint);
  EXPECT_EQ(newest.scene, "a.yaml");
  const CommandLine named = parsed({"a.yaml", "--restart", "000000000100.h5", "-log_view"});
  EXPECT_TRUE(named.restart);
  EXPECT_EQ(named.checkpoint, "000000000100.h5");
  EXPECT_THAT(named.petsc, ElementsAre("-log_view"));
  const CommandLine joined = parsed({"--restart=out/000000000100.h5", "a.yaml"});
  EXPECT_TRUE(joined.restart);
  EXPECT_EQ(joined.checkpoint, "out/000000000100.h5");
  EXPECT_EQ(joined.scene, "a.yaml");
  EXPECT_THAT(refusal({"--restart=b.yaml", "a.yaml"}),
              HasSubstr("--restart is b.yaml (a checkpoint ends with .h5)"));
  EXPECT_THAT(refusal({"--restart", "--overwrite", "a.yaml"}), HasSubstr("Give one of them"));
}

TEST(CommandLineOptions, ALimitOfTimeHasAUnit)
{
  EXPECT_DOUBLE_EQ(*parsed({"--time-limit", "90 min", "a.yaml"}).time_limit, 5400);
  EXPECT_DOUBLE_EQ(*parsed({"a.yaml", "--time-limit=2 h"}).time_limit, 7200);
  EXPECT_FALSE(parsed({"a.yaml"}).time_limit);
  for (const char* wrong : {"5", "0 s", "-3 s", "4 m", "soon"})
    EXPECT_THAT(refusal({"a.yaml", "--time-limit", wrong}),
                HasSubstr(std::string("--time-limit is ") + wrong));
}

TEST(CommandLineOptions, PetscGetsItsOwnWithTheirValues)
{
  const CommandLine line = parsed(
      {"a.yaml", "-log_view", ":t.txt", "-da_shift", "-5", "--check", "-ksp_monitor", "-o", "out"});
  EXPECT_THAT(line.petsc, ElementsAre("-log_view", ":t.txt", "-da_shift", "-5", "-ksp_monitor"));
  EXPECT_TRUE(line.check);
  EXPECT_EQ(line.output, "out");
}

TEST(CommandLineOptions, ASelfTestTakesNoScene)
{
  const CommandLine line = parsed({"--self-test", "-o", "here", "--quiet"});
  EXPECT_TRUE(line.self_test);
  EXPECT_TRUE(line.quiet);
  EXPECT_EQ(line.output, "here");
  EXPECT_THAT(refusal({"--self-test", "a.yaml"}),
              HasSubstr("a scene does not go with --self-test"));
  for (const Words& other : {Words{"--check"}, Words{"--set", "steps=3"}, Words{"--restart"},
                             Words{"--overwrite"}, Words{"--time-limit", "3 s"}}) {
    Words words = other;
    words.push_back("--self-test");
    EXPECT_THAT(refusal(words), HasSubstr(other.front() + " does not go with --self-test"));
  }
}

TEST(CommandLineOptions, HelpFitsATerminal)
{
  std::istringstream lines(answer({"--help"}));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(CommandLineOptions, WrongUsageIsTold)
{
  EXPECT_EQ(refusal({"--chek", "a.yaml"}), "unknown option '--chek' (did you mean '--check'?)");
  EXPECT_EQ(refusal({}), "no scene named. Write mpm_par scene.yaml, or see mpm_par --help.");
  EXPECT_EQ(refusal({"a.yaml", "b.yaml"}),
            "'b.yaml' is a second scene (one run is one scene). Put a list or a value with spaces "
            "in quotes.");
  EXPECT_EQ(refusal({"-log_view", "a.yaml"}),
            "unknown option '-log_view' (before the scene). Put options for PETSc behind the "
            "scene.");
  EXPECT_THAT(refusal({"a.yaml", "--set"}), HasSubstr("See mpm_par --help."));
}

TEST(CommandLineOptions, QuestionsAreAnsweredWithoutAScene)
{
  EXPECT_THAT(answer({"--help"}), HasSubstr("--set PATH=VALUE"));
  EXPECT_EQ(answer({"--version"}), "mpm_par 1.2.3\nPETSc 4.5\n");
  EXPECT_THAT(answer({"--input-reference"}), HasSubstr("## material"));
  EXPECT_THAT(answer({"--input-schema"}), HasSubstr("\"strain_measure\""));
}

}  // namespace
}  // namespace mpm::scene
