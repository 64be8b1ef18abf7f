#include <mpm/core/printable.hpp>

#include <string>

#include <gmock/gmock.h>

namespace mpm {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

TEST(Unprintable, PassesWhatPeopleWrite)
{
  for (const char* text :
       {"", "Pinus taeda L.", "Höhe 3 µm, 木材, \xF0\x9F\x8C\xB2", "two\nlines\tand a tab\r\n"})
    EXPECT_EQ(unprintable(text), std::nullopt) << text;
}

TEST(Unprintable, NamesTheByteThatIsNoUtf8)
{
  // Latin-1; a character cut off; one longer than needed; half a pair of UTF-16; behind the last.
  for (const char* text :
       {"Bl\xF6"
        "ck",
        "Bl\xC3", "Bl\xC0\xAF", "Bl\xED\xA0\x80", "Bl\xF4\x90\x80\x80", "Bl\x80", "Bl\xFF"})
    EXPECT_THAT(unprintable(text), Optional(HasSubstr("byte 3 is 0x"))) << text;
}

TEST(Unprintable, NamesControlCharacters)
{
  EXPECT_THAT(unprintable("ring \x07"),
              Optional(HasSubstr("byte 6 is the control character 0x07")));
  EXPECT_THAT(unprintable("\x1B[31mred"), Optional(HasSubstr("0x1B")));
  EXPECT_THAT(unprintable(std::string("a\0b", 3)), Optional(HasSubstr("0x00")));
  EXPECT_THAT(unprintable("\x7F"), Optional(HasSubstr("0x7F")));
}

TEST(Shortened, CutsBetweenCharactersOnOneLine)
{
  EXPECT_EQ(shortened("a\nb"), "a b");
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abcdef...");
  EXPECT_EQ(shortened("abcde\xC3\xB6", 6), "abcde...");  // not half of an o with dots
}

}  // namespace
}  // namespace mpm
