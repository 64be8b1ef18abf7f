#include "scene_folder.hpp"
#include <gmock/gmock.h>

namespace mpm::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using SceneFile = SceneFolder;

TEST_F(SceneFile, ThatDoesNotExist)
{
  EXPECT_THAT(problems_of(folder_ / "b.yaml"),
              ElementsAre("b.yaml: no such scene file. Check the path (it counts from the working "
                          "directory)."));
}

TEST_F(SceneFile, ThatIsADirectory)
{
  std::filesystem::create_directory(folder_ / "scenes");
  EXPECT_THAT(problems_of(folder_ / "scenes"),
              ElementsAre("scenes: is a directory. Name the scene file inside it."));
}

TEST_F(SceneFile, ThatIsEmptyOrOnlyComments)
{
  const std::string message = "a.yaml: is empty. A scene needs at least 'specimen' and 'loading'.";
  EXPECT_THAT(problems(""), ElementsAre(message));
  EXPECT_THAT(problems("# nothing yet\n"), ElementsAre(message));
}

TEST_F(SceneFile, ThatMayNotBeRead)
{
  const auto file = write("a.yaml", smallest);
  std::filesystem::permissions(file, std::filesystem::perms::none);
  if (std::ifstream(file).is_open()) GTEST_SKIP() << "this user may read every file";
  EXPECT_THAT(problems_of(file), ElementsAre("a.yaml: cannot be read. Check its permissions."));
}

TEST_F(SceneFile, WithASyntaxErrorNamesThePlace)
{
  EXPECT_THAT(
      problems("specimen: [1, 2\nloading: 3\n"),
      ElementsAre(
          "a.yaml:2:8: not YAML: end of sequence flow not found. Look at brackets, quotes and "
          "indentation here and one line above."));
}

TEST_F(SceneFile, IndentedWithTabsIsTold)
{
  EXPECT_THAT(problems("specimen:\n\tmicrograph: wood.png\n"),
              ElementsAre(HasSubstr("YAML does not indent with tabs: use spaces.")));
}

TEST_F(SceneFile, OfAnotherSystemIsReadAsItIs)
{
  const std::string text = "# caf\xC3\xA9\ntitle: \"d\xC3\xA9j\xC3\xA0 vu\"\n" + smallest +
                           "name: 'it''s'\noutput: {fields: ['stress','velocity']}\n";
  std::string windows = "\xEF\xBB\xBF";
  for (const char letter : text) windows += letter == '\n' ? "\r\n" : std::string(1, letter);
  for (const std::string& written : {text, windows}) {
    EXPECT_THAT(problems(written), ElementsAre());
    const Scene scene = read_scene(write("a.yaml", written), {});
    EXPECT_EQ(scene.title, "d\xC3\xA9j\xC3\xA0 vu");
    EXPECT_EQ(scene.name, "it's");
    const std::string open = std::string(written).replace(written.find("vu\""), 3, "vu");
    EXPECT_THAT(problems(open), ElementsAre("a.yaml:2:8: nothing closes the quote that opens here. "
                                            "Put another \" behind the text."));
  }
}

TEST_F(SceneFile, ThatIsAList)
{
  EXPECT_THAT(
      problems("- 1\n- 2\n"),
      ElementsAre("a.yaml:1:1: the scene is [1, 2] (must be a map of keys). Begin with e.g. "
                  "'specimen:' and 'loading:'."));
}

TEST_F(SceneFile, WithTwoDocuments)
{
  EXPECT_THAT(problems(smallest + "---\ntitle: b\n"),
              ElementsAre(HasSubstr("a second document starts here")));
}

TEST_F(SceneFile, WithAnAnchorInsideItself)
{
  EXPECT_THAT(problems("a: &x [*x]\n"), ElementsAre(HasSubstr("nested more than 50 deep")));
}

TEST_F(SceneFile, WithAnchorsThatMultiplyIsRefusedAtOnce)
{
  // Nine lines that stand for 10^9 values.
  std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int k = 1; k < 9; ++k) {
    const std::string last = "*a" + std::to_string(k - 1), name = std::to_string(k);
    text.append("a").append(name).append(": &a").append(name).append(" [");
    for (int i = 0; i < 10; ++i) text += (i > 0 ? ", " : "") + last;
    text += "]\n";
  }
  // As many as it has characters, and 100,000.
  EXPECT_THAT(
      problems(text),
      ElementsAre(HasSubstr("the scene has more than " + std::to_string(text.size() + 100000) +
                            " values (anchors that multiply?). Write out what is "
                            "needed.")));
  EXPECT_THAT(problems(text), ElementsAre(testing::StartsWith("a.yaml:")));
  const std::string few = "title: &t [a]\nname: *t\n";
  EXPECT_THAT(problems(few), testing::Not(testing::Contains(HasSubstr("more than"))));
}

TEST_F(SceneFile, NamesThePictureFromItsOwnFolder)
{
  std::filesystem::create_directory(folder_ / "scenes");
  write("scenes/a.yaml",
        "specimen: {micrograph: ../wood.png}\nloading: {piston: top, speed: 1 m/s}\n");
  EXPECT_EQ(read_scene(folder_ / "scenes" / "a.yaml").specimen.micrograph->file,
            folder_ / "wood.png");
}

}  // namespace
}  // namespace mpm::scene
