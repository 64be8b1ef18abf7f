#include <mpm/core/one_of.hpp>
#include <mpm/core/type_list.hpp>

#include <gmock/gmock.h>

namespace mpm {

struct Fruit {
  std::string_view keyword;
  int seeds;
};

namespace {

struct Cherry {
  static constexpr Fruit row{"cherry", 1};
};
struct Apple {
  static constexpr Fruit row{"apple", 8};
};

}  // namespace

template <>
std::span<const Fruit> list_of<Fruit>()
{
  return rows_of<Fruit>(TypeList<Cherry, Apple>{});
}

namespace {

TEST(OneOfAList, IsTheRowWithItsKeywordAndTheFirstUnlessSaidOtherwise)
{
  const OneOf<Fruit> apple = "apple", unsaid;
  EXPECT_EQ(apple->seeds, 8);
  EXPECT_EQ(apple.index(), 1u);
  EXPECT_EQ(unsaid, "cherry");
  EXPECT_NE(apple, unsaid);
  EXPECT_EQ(apple, OneOf<Fruit>(std::string_view("apple")));
  EXPECT_LT(unsaid, apple);
}

TEST(OneOfAList, RefusesAKeywordThatIsNotInTheList)
{
  EXPECT_THROW(OneOf<Fruit>("pear"), std::invalid_argument);
}

TEST(OneOfAList, TheListKeepsTheOrderOfTheTypes)
{
  EXPECT_THAT(keywords<Fruit>(), testing::ElementsAre("cherry", "apple"));
  std::string visited;
  for_each_type(TypeList<Cherry, Apple>{}, [&]<class T>() { visited += T::row.keyword; });
  EXPECT_EQ(visited, "cherryapple");
  EXPECT_EQ(all_of_list<Fruit>().size(), 2u);
}

}  // namespace
}  // namespace mpm
