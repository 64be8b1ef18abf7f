#include <mpm/core/formula.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace mpm {
namespace {

using testing::HasSubstr;

TEST(Formula, OfPlaceAndTimeGivesWhatTheLanguageGives)
{
  const Formula formula("2*sin(pi*x)*exp(-y) + t^2 - sqrt(4)/z", 3);
  for (const std::array<double, 3>& p : {std::array{0.3, -0.2, 0.7}, std::array{-1.5, 4.0, 1e-3}})
    for (const double t : {0.0, 1e-6, 3.0})
      // A few roundings of terms of a size below 2000.
      EXPECT_NEAR(formula(p, t),
                  2 * std::sin(std::numbers::pi * p[0]) * std::exp(-p[1]) + t * t - 2 / p[2],
                  1e-12);
}

TEST(Formula, CopiesAreEqualAndDoNotDisturbEachOther)
{
  const Formula one("x + 10*t", 2), copy = one;
  const std::array<double, 2> a{1, 0}, b{2, 0};
  EXPECT_EQ(one(a, 0.5), 6);
  EXPECT_EQ(copy(b, 0), 2);
  EXPECT_EQ(one(a, 0), 1);
  EXPECT_EQ(one, copy);
  EXPECT_FALSE(one == Formula("x + 11*t", 2));
}

TEST(Formula, OfNothingIsZero)
{
  const Formula none;
  EXPECT_EQ(none(std::array<double, 2>{3, 4}, 5), 0);
  EXPECT_EQ(none, Formula("0", 2));
}

TEST(Formula, ANumberKeepsAllItsDigits)
{
  EXPECT_EQ(Formula("0.33333333333333331", 2)(std::array<double, 2>{}, 0), 1.0 / 3);
  EXPECT_EQ(Formula("-6.02e+23", 2)(std::array<double, 2>{}, 0), -6.02e23);
  EXPECT_EQ(Formula("1.25e-09", 2)(std::array<double, 2>{}, 0), 1.25e-9);
}

std::string refusal(const std::string& text, int dimensions)
{
  try {
    const Formula formula(text, dimensions);
  } catch (const FormulaError& error) {
    return std::string(error.what()) + ". " + error.remedy();
  }
  return "no error";
}

TEST(Formula, TextsThatAreNoneAreRefusedWithTheParsersReasonAndARemedy)
{
  EXPECT_THAT(refusal("sin(z)", 2), HasSubstr("is no formula: Unexpected token \"z\" found at "
                                              "position 4. Use numbers, x, y, t, pi,"));
  EXPECT_THAT(refusal("2*(x+1", 3), HasSubstr("is no formula: Missing parenthesis"));
  EXPECT_THAT(refusal("2*(x+1", 3), HasSubstr("Use numbers, x, y, z, t, pi,"));
  EXPECT_THAT(refusal("", 2), HasSubstr("is no formula"));
  EXPECT_THAT(refusal("x, y", 2), HasSubstr("is no formula: it has several values"));
}

TEST(Formula, TellsThePlaceNowFromThePlaceAtTheStart)
{
  const Formula moved("x - X + 10*(Z - z)", 3), now("x + y + z", 3);
  const std::array<double, 3> place{3, 4, 5}, start{1, 4, 7};
  EXPECT_EQ(moved(place, start, 0), 2 + 20);
  EXPECT_EQ(moved(place, 0), 0) << "where nothing has moved both are the same";
  EXPECT_TRUE(moved.uses_initial_place());
  EXPECT_FALSE(now.uses_initial_place());
}

TEST(Formula, UsesDefinitionsAndThroughThemThoseBefore)
{
  const Definitions names{{"E", "2e6"},        {"c", "sqrt(E/2)"}, {"unused", "1/0"},
                          {"wave", "x - c*t"}, {"start", "X + c"}, {"both", "wave^2 + c"}};
  const Formula formula("both + wave", 2, names);
  for (const double t : {0.0, 1e-3, 0.7})
    for (const double x : {-1.0, 4.0}) {
      const double wave = x - 1000 * t;
      EXPECT_EQ(formula(std::array{x, 9.0}, t), wave * wave + 1000 + wave);
    }
  EXPECT_EQ(Formula("c", 2, names)(std::array{1.0, 1.0}, 1), 1000);
  EXPECT_TRUE(Formula("start", 2, names).uses_initial_place());
  EXPECT_FALSE(formula.uses_initial_place());
}

TEST(Formula, ADefinitionSeesOnlyThoseBeforeIt)
{
  const Definitions names{{"a", "b"}, {"b", "1"}};
  EXPECT_THROW(Formula("a", 2, names), FormulaError);
  EXPECT_EQ(Formula("b", 2, names)(std::array{0.0, 0.0}, 0), 1);
}

TEST(Formula, NamesThatMeanSomethingAlreadyAreRefused)
{
  const Definitions others{{"taken", "1"}};
  for (const char* name : {"x", "Z", "t", "pi", "sin", "taken", "2x", "a b", "", "a-b"})
    EXPECT_THROW(check_name({name, ""}, others), FormulaError) << name;
  for (const char* name : {"E", "c_0", "x1", "Taken", "_a"})
    EXPECT_NO_THROW(check_name({name, ""}, others)) << name;
}

}  // namespace
}  // namespace mpm
