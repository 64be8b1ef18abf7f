#include <mpm/core/error.hpp>
#include <mpm/materials/laws.hpp>

#include <gmock/gmock.h>

namespace mpm {
namespace {

using testing::HasSubstr;

std::string refusal(const auto& make)
{
  try {
    make();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LawList, ALawThatIsNotThereInPlaneOrSpaceIsRefusedWithThoseThatAre)
{
  const OneOf<LawRow> oriented = "transversely_isotropic", rigid = "rigid";
  EXPECT_THAT(refusal([&] { make_law<3>(*oriented, {}, PlaneAssumption::strain); }),
              HasSubstr("law transversely_isotropic is there in the plane only. Use one of: "
                        "isotropic, neo_hookean, von_mises"));
  EXPECT_THAT(refusal([&] { make_law<2>(*rigid, {}, PlaneAssumption::strain); }),
              HasSubstr("law rigid has no stress. Use one of: isotropic, transversely_isotropic"));
  LawRow space_only = *OneOf<LawRow>("isotropic");
  space_only.in_plane = nullptr;
  EXPECT_THAT(refusal([&] { make_law<2>(space_only, {}, PlaneAssumption::strain); }),
              HasSubstr("is there in space only"));
}

TEST(LawList, DefaultsFillWhatHasNoValueAndLeaveTheRest)
{
  const OneOf<LawRow> law = "von_mises";
  ParameterValues values{{"hardening_modulus", 3.0}};
  fill_defaults(*law, values);
  EXPECT_EQ(values.number("hardening_modulus"), 3);
  EXPECT_EQ(values.word("strain_measure"), "hencky");
  EXPECT_FALSE(values.has("yield_stress"));  // required
}

TEST(LawList, ExamplesOfAllParametersLieWithinTheirBoundsAndGoTogether)
{
  for (const LawRow& law : list_of<LawRow>()) {
    ParameterValues values;
    fill_defaults(law, values);
    for (const KindParameter& parameter : law.parameters) {
      EXPECT_FALSE(parameter.help.empty());
      if (parameter.default_value()) continue;
      EXPECT_EQ(parameter.bound.violation(parameter.example), std::nullopt) << parameter.key;
      values.set(parameter.key, parameter.example);
    }
    if (law.check) {
      EXPECT_FALSE(law.check(values)) << law.keyword;
    }
  }
}

}  // namespace
}  // namespace mpm
