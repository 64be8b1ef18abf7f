#include <mpm/core/error.hpp>
#include <mpm/core/units.hpp>

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mpm {
namespace {

using testing::HasSubstr;

struct Case {
  std::string text;
  Quantity quantity;
  double si;
};
class Readable : public testing::TestWithParam<Case> {};

// A factor that is a power of ten shifts the decimal point: the result is the double nearest to the
// decimal number, hence equality.
TEST_P(Readable, BecomesExactlyTheSiValue)
{
  const Case& c = GetParam();
  EXPECT_EQ(to_si(c.text, c.quantity), c.si) << c.text;
}

INSTANTIATE_TEST_SUITE_P(
    Units, Readable,
    testing::Values(
        Case{"10.6 GPa", Quantity::pressure, 10.6e9}, Case{"10.6GPa", Quantity::pressure, 10.6e9},
        Case{"500 N/mm^2", Quantity::pressure, 500e6}, Case{"1e3 kPa", Quantity::pressure, 1e6},
        Case{"0.832 mm", Quantity::length, 0.832e-3}, Case{"12 µm", Quantity::length, 12e-6},
        Case{"12 um", Quantity::length, 12e-6}, Case{"1.5 g/cm^3", Quantity::density, 1500},
        Case{"1500 kg/m3", Quantity::density, 1500}, Case{"-3 m/s", Quantity::velocity, -3},
        Case{"+36 km/h", Quantity::velocity, 10}, Case{"2.5 us", Quantity::time, 2.5e-6},
        Case{"60 %", Quantity::fraction, 0.6}, Case{"0.6", Quantity::fraction, 0.6},
        Case{"150", Quantity::number, 150}, Case{"9.81 m/s^2", Quantity::acceleration, 9.81},
        Case{"3 mm/us^2", Quantity::acceleration, 3e9}, Case{"2 1/ms", Quantity::rate, 2000},
        Case{"2 ms^-1", Quantity::rate, 2000}, Case{"5 kHz", Quantity::rate, 5000}));

TEST(Units, DegreesBecomeRadians)
{
  const double right_angle = 1.5707963267948966;
  for (const char* text : {"90 deg", "90 °", "90 degrees"})
    EXPECT_DOUBLE_EQ(to_si(text, Quantity::angle), right_angle) << text;
}

struct Refused {
  std::string text;
  Quantity quantity;
  std::string reason, remedy;
};
class Unreadable : public testing::TestWithParam<Refused> {};

TEST_P(Unreadable, IsRefusedWithReasonAndExample)
{
  const Refused& r = GetParam();
  try {
    const double value = to_si(r.text, r.quantity);
    FAIL() << r.text << " was read as " << value;
  } catch (const UnitError& error) {
    EXPECT_EQ(error.what(), r.reason);
    EXPECT_EQ(error.remedy(), r.remedy);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Units, Unreadable,
    testing::Values(Refused{"10", Quantity::pressure, "a pressure needs a unit",
                            "Write e.g. 10.6 GPa"},
                    Refused{"7 MPA", Quantity::pressure, "unknown unit 'MPA', did you mean 'MPa'?",
                            "Write e.g. 10.6 GPa"},
                    Refused{"10 mm", Quantity::pressure, "mm is a length, not a pressure",
                            "Write e.g. 10.6 GPa"},
                    Refused{"3 kelvin", Quantity::time, "kelvin is not a time", "Write e.g. 1 us"},
                    Refused{"fast", Quantity::velocity, "must be a velocity", "Write e.g. 10 m/s"},
                    Refused{"0,832 mm", Quantity::length,
                            "the decimal sign is a point, not a comma", "Write e.g. 0.832 mm"},
                    Refused{"nan m", Quantity::length, "must be a length", "Write e.g. 0.832 mm"},
                    Refused{"5 MPa", Quantity::number, "takes no unit", "Write e.g. 10"},
                    Refused{"0.6 m", Quantity::fraction, "a fraction takes no unit but %",
                            "Write e.g. 0.6 or 60 %"}));

// The library below converts these without a word, to 0.1 s, 0.2 m/s, 100 GPa, 21 MPa, 15 m and
// 0.3 rad.
INSTANTIATE_TEST_SUITE_P(
    SilentTraps, Unreadable,
    testing::Values(
        Refused{"10 Hz", Quantity::time, "Hz is a rate, not a time", "Write e.g. 1 us"},
        Refused{"5 s/m", Quantity::velocity, "s/m is not a velocity", "Write e.g. 10 m/s"},
        Refused{"10 10 GPa", Quantity::pressure, "'10 GPa' is not a unit: a value has one number",
                "Write e.g. 10.6 GPa"},
        Refused{"10 2/s", Quantity::rate, "'2/s' is not a unit: a value has one number",
                "Write e.g. 1000 1/s"},
        Refused{"7 MPa 3", Quantity::pressure, "'MPa 3' is not a unit: a value has one number",
                "Write e.g. 10.6 GPa"},
        Refused{"10 m @ 5", Quantity::length, "'m @ 5' is not a unit: a value has one number",
                "Write e.g. 0.832 mm"},
        Refused{"30 %", Quantity::angle, "% is not an angle", "Write e.g. 30 deg"}));

TEST(Units, MissingTableOfUnitsIsAFileErrorWithRemedy)
{
  try {
    const UnitTable table("/nowhere/units.xml");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/units.xml: cannot read the table of units"));
    EXPECT_THAT(error.what(), HasSubstr("libudunits2-data"));
  }
}

TEST(ReadableUnits, AreShortAndCustomary)
{
  EXPECT_EQ(in_readable_unit(10.6e9, Quantity::pressure), "10.6 GPa");
  EXPECT_EQ(in_readable_unit(0.832e-3, Quantity::length), "832 um");
  EXPECT_EQ(in_readable_unit(1500, Quantity::density), "1500 kg/m^3");
  EXPECT_EQ(in_readable_unit(0, Quantity::velocity), "0 m/s");
  EXPECT_EQ(in_readable_unit(0.6, Quantity::fraction), "0.6");
}

TEST(ReadableUnits, ReadBackToTheSameBits)
{
  for (const Quantity quantity :
       {Quantity::length, Quantity::time, Quantity::velocity, Quantity::pressure, Quantity::density,
        Quantity::angle, Quantity::fraction, Quantity::number, Quantity::acceleration,
        Quantity::rate}) {
    double value = 1.0 / 3.0;
    for (int i = 0; i < 40; ++i, value *= 3.7e-1)
      EXPECT_EQ(to_si(in_readable_unit(value, quantity), quantity), value);
  }
}

}  // namespace
}  // namespace mpm
