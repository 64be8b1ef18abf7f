#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace mpm {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// An owner of every kind of value, some of them in a section.
struct Owner {
  double time = 0;
  std::int64_t steps = 0;
  int width = 0;
  std::array<double, 3> force{};
  std::array<std::int64_t, 2> box{};
  std::vector<double> masses;
  std::vector<std::int64_t> ids;
  std::string name;

  void archive(Archive& archive)
  {
    archive.value("time", time);
    archive.value("steps", steps);
    archive.value("width", width);
    const Archive::Section section(archive, "body");
    archive.values("force", force);
    archive.values("box", box);
    {
      const Archive::Section inner(archive, "particles");
      archive.list("mass", masses);
      archive.list("id", ids);
    }
    archive.text("name", name);
  }
  bool operator==(const Owner&) const = default;
};

Owner full_owner()
{
  return {1.0 / 3, 1LL << 60, -7, {0.1, -0.0, 1e-310}, {-1, 2}, {2.5, 3.5, 4.5}, {}, "wood"};
}

MemoryArchive saved(Owner owner)
{
  MemoryArchive archive;
  archive.start_saving();
  owner.archive(archive);
  return archive;
}

/// What loading says.
template <class Load>
std::string words_of(MemoryArchive& archive, const Load& load)
{
  archive.start_loading();
  try {
    load(archive);
  } catch (const InputError& error) {
    return error.what();
  }
  return "loaded";
}

TEST(MemoryArchive, EveryKindOfValueComesBackAsOftenAsWanted)
{
  MemoryArchive archive = saved(full_owner());
  for (int time = 0; time < 2; ++time) {
    archive.start_loading();
    Owner owner{.masses = {9}, .ids = {8, 7}, .name = "air"};
    owner.archive(archive);
    EXPECT_EQ(owner, full_owner());
    EXPECT_TRUE(std::signbit(owner.force[1]));
    EXPECT_THAT(archive.unread(), IsEmpty());
  }
}

TEST(MemoryArchive, SavingAgainForgetsWhatWasThere)
{
  MemoryArchive archive = saved(full_owner());
  double only = 4;
  archive.start_saving();
  archive.value("only", only);
  EXPECT_THAT(words_of(archive, [](Archive& a) { Owner().archive(a); }),
              HasSubstr("time is not there"));
  EXPECT_THAT(archive.unread(), ElementsAre("only"));
}

TEST(MemoryArchive, SavingAgainTakesOtherLengthsAndKinds)
{
  MemoryArchive archive = saved(full_owner());
  Owner owner{.masses = {1, 2, 3, 4, 5}, .ids = {6}, .name = "moist wood"};
  archive.start_saving();
  owner.archive(archive);
  EXPECT_THAT(differences(archive, saved(owner)), IsEmpty());
  std::vector<std::int64_t> masses{7};
  archive.start_saving();
  {
    const Archive::Section body(archive, "body"), particles(archive, "particles");
    archive.list("mass", masses);
  }
  archive.start_loading();
  const Archive::Section body(archive, "body"), particles(archive, "particles");
  std::vector<std::int64_t> loaded;
  archive.list("mass", loaded);
  EXPECT_THAT(loaded, ElementsAre(7));
}

TEST(MemoryArchive, ANameThatIsNotThereIsNamedWithItsSections)
{
  MemoryArchive archive = saved(full_owner());
  double value = 1;
  EXPECT_THAT(words_of(archive,
                       [&](Archive& a) {
                         const Archive::Section body(a, "body"), particles(a, "particles");
                         a.value("volume", value);
                       }),
              HasSubstr("body/particles/volume is not there"));
  EXPECT_EQ(value, 1);
}

TEST(MemoryArchive, ValuesOfAnotherKindOrNumberAreNamed)
{
  MemoryArchive archive = saved(full_owner());
  std::vector<double> numbers;
  std::vector<std::int64_t> whole;
  std::array<double, 2> pair{5, 6};
  std::string text;
  const auto words = [&](const auto& load) { return words_of(archive, load); };
  EXPECT_THAT(words([&](Archive& a) { a.list("steps", numbers); }),
              HasSubstr("steps is whole numbers, not numbers"));
  EXPECT_THAT(words([&](Archive& a) { a.list("time", whole); }),
              HasSubstr("time is numbers, not whole numbers"));
  EXPECT_THAT(words([&](Archive& a) { a.text("time", text); }),
              HasSubstr("time is numbers, not text"));
  EXPECT_THAT(words([&](Archive& a) {
                const Archive::Section body(a, "body");
                a.values("force", pair);
              }),
              HasSubstr("body/force has 3 values, not 2"));
  EXPECT_THAT(pair, ElementsAre(5, 6));
}

TEST(MemoryArchive, SectionsEndWhereAnErrorLeavesThem)
{
  MemoryArchive archive = saved(full_owner());
  words_of(archive, [](Archive& a) {
    const Archive::Section section(a, "nowhere");
    double value;
    a.value("value", value);
  });
  Owner owner;
  owner.archive(archive);
  EXPECT_EQ(owner, full_owner());
}

TEST(MemoryArchive, WhatNobodyAskedForIsListed)
{
  MemoryArchive archive = saved(full_owner());
  archive.start_loading();
  double time;
  archive.value("time", time);
  EXPECT_THAT(archive.unread(),
              ElementsAre("body/box", "body/force", "body/name", "body/particles/id",
                          "body/particles/mass", "steps", "width"));
}

TEST(MemoryArchive, TwoValuesOfOneNameAreOurMistake)
{
  MemoryArchive archive;
  archive.start_saving();
  double value = 1;
  archive.value("time", value);
  const Archive::Section section(archive, "body");
  archive.value("time", value);
  EXPECT_THROW(archive.value("time", value), std::logic_error);
}

TEST(MemoryArchive, DifferencesAreFoundToTheLastBit)
{
  Owner other = full_owner();
  EXPECT_THAT(differences(saved(full_owner()), saved(other)), IsEmpty());
  other.time = std::nextafter(other.time, 1.0);
  other.force[1] = 0.0;  // the sign of a zero
  other.ids = {1};
  EXPECT_THAT(differences(saved(full_owner()), saved(other)),
              ElementsAre("body/force", "body/particles/id", "time"));

  other = full_owner();
  other.force[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(differences(saved(other), saved(other)), IsEmpty());

  MemoryArchive more = saved(full_owner()), less;
  more.value("mass", other.time);
  less.start_saving();
  EXPECT_THAT(differences(saved(full_owner()), more), ElementsAre("mass"));
  EXPECT_THAT(differences(more, saved(full_owner())), ElementsAre("mass"));
  EXPECT_THAT(differences(less, more), ::testing::SizeIs(9));
}

}  // namespace
}  // namespace mpm
