#include <mpm/core/folded.hpp>

#include <gtest/gtest.h>

namespace mpm {
namespace {

TEST(Folded, ShortTextStaysAsItIs)
{
  EXPECT_EQ(folded("150 x 98 cells", 21), "150 x 98 cells");
  EXPECT_EQ(folded("", 21), "");
  EXPECT_EQ(folded(std::string(60, 'a'), 20), std::string(60, 'a'));
}

TEST(Folded, LinesEndBeforeColumnEightyAndTheNextIsIndented)
{
  const std::string word(29, 'a');  // two and a blank make 59
  EXPECT_EQ(folded(word + " " + word + " " + word, 21),
            word + " " + word + "\n" + std::string(21, ' ') + word);
  EXPECT_EQ(folded(word + " " + word + " " + word, 22),  // 22 + 59 is beyond
            word + "\n" + std::string(22, ' ') + word + "\n" + std::string(22, ' ') + word);
}

TEST(Folded, AWordThatIsTooLongIsNotCut)
{
  const std::string path(100, 'p');
  EXPECT_EQ(folded("in " + path, 4), "in\n    " + path);
}

TEST(FoldedMessage, FoldsLongLinesEachByItself)
{
  const std::string word(39, 'a'), two = word + " " + word, three = two + " " + word;
  EXPECT_EQ(folded_message("short\n\n" + two), "short\n\n" + two);
  EXPECT_EQ(folded_message(three + "\n  " + three), word + "\n    " + word + "\n    " + word +
                                                        "\n  " + word + "\n      " + word +
                                                        "\n      " + word);
  EXPECT_EQ(folded_message(""), "");
  EXPECT_EQ(folded_message("one\n"), "one\n");
}

}  // namespace
}  // namespace mpm
