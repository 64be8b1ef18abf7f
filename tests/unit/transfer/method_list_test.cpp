// The lists of schemes and update orders, and the stable steps of their combinations.
#include <mpm/transfer/transfer.hpp>

#include <gmock/gmock.h>

namespace mpm {
namespace {

std::optional<double> cfl(OneOf<ShapeRow> shape, OneOf<SchemeRow> scheme,
                          OneOf<UpdateOrderRow> order)
{
  return stable_cfl(*shape, *scheme, *order);
}

TEST(MethodLists, StableStepsAreThoseOfTheTableInTheory)
{
  for (const char* order : {"musl", "usf"}) {
    EXPECT_EQ(cfl("linear", "flip", order), 1.42);
    EXPECT_EQ(cfl("gimp", "flip", order), 1.75);
    EXPECT_EQ(cfl("quadratic", "pic", order), 1.86);
    EXPECT_EQ(cfl("gimp", "tpic", order), 0.9);
    EXPECT_EQ(cfl("linear", "apic", order), std::nullopt);
  }
  EXPECT_EQ(cfl("gimp", "apic", "usl"), 0.59);
  EXPECT_EQ(cfl("quadratic", "flip", "usl"), 0.69);
  EXPECT_EQ(cfl("cubic", "flip", "musl"), 2.58);
  EXPECT_EQ(cfl("linear", "flip", "usl"), std::nullopt);
}

TEST(MethodLists, EveryShapeFunctionGoesWithEverySchemeInThePlaneAndInSpace)
{
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>())
    for (const OneOf<SchemeRow> scheme : all_of_list<SchemeRow>()) {
      const auto plane = make_transfer<2>(shape, scheme, {0.5});
      const auto space = make_transfer<3>(shape, scheme, {0.5});
      ASSERT_TRUE(plane && space);
      EXPECT_EQ(plane->support(), space->support());
      int components = 0;
      for (const Column& column : space->motion_columns(false)) components += column.components;
      const int domain = shape == "cpdi" ? 9 : 0;
      EXPECT_EQ(components, (scheme->affine ? 16 : 7) + domain) << scheme->keyword;
    }
}

TEST(MethodLists, EveryRowHasItsWords)
{
  for (const SchemeRow& row : list_of<SchemeRow>())
    EXPECT_FALSE(row.help.empty() || row.words.empty());
  for (const UpdateOrderRow& row : list_of<UpdateOrderRow>())
    EXPECT_FALSE(row.help.empty() || row.words.empty());
}

}  // namespace
}  // namespace mpm
