#include <mpm/materials/laws.hpp>

#include <cmath>

#include "material_point.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

TEST(NeoHookean, SimpleShearHasAStressLinearInTheShearAndANormalStressInItsSquare)
{
  const OneOf<LawRow> law = "neo_hookean";
  MaterialPoint<3> point(make_law<3>(
      *law, {{"density", 1000.0}, {"youngs_modulus", 3.0}, {"poisson_ratio", 0.25}}, {}));
  constexpr double mu = 3.0 / (2 * 1.25);
  Eigen::Matrix3d step = Eigen::Matrix3d::Identity();
  step(0, 1) = 0.5;
  for (const double gamma : {0.5, 1.0, 1.5}) {
    point.apply(step);
    EXPECT_NEAR(point.kirchhoff()(0, 1), mu * gamma, 1e-14);  // a few roundings
    EXPECT_NEAR(point.kirchhoff()(0, 0), mu * gamma * gamma, 1e-14);
  }
}

TEST(NeoHookean, OfThePlaneIsTheOneInSpaceWithTheThicknessThatThePlaneHas)
{
  const OneOf<LawRow> law = "neo_hookean";
  const ParameterValues values{
      {"density", 1000.0}, {"youngs_modulus", 3.0}, {"poisson_ratio", 0.3}};
  constexpr double mu = 3.0 / 2.6, lambda = 3.0 * 0.3 / (1.3 * 0.4);
  Eigen::Matrix2d plane;
  plane << 1.3, 0.2, -0.1, 0.6;
  for (const PlaneAssumption assumption : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    double thickness = 1;
    if (assumption == PlaneAssumption::stress) {
      // mu (l^2 - 1) + lambda ln(J l) = 0 by bisection.
      double lower = 0.1, upper = 10;
      for (int k = 0; k < 100; ++k) {
        thickness = 0.5 * (lower + upper);
        const double tau =
            mu * (thickness * thickness - 1) + lambda * std::log(plane.determinant() * thickness);
        (tau > 0 ? upper : lower) = thickness;
      }
    }
    Eigen::Matrix3d space = Eigen::Matrix3d::Identity();
    space.topLeftCorner<2, 2>() = plane;
    space(2, 2) = thickness;
    MaterialPoint<2> flat(make_law<2>(*law, values, assumption));
    MaterialPoint<3> solid(make_law<3>(*law, values, assumption));
    flat.apply(plane);
    solid.apply(space);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        EXPECT_NEAR(flat.kirchhoff()(i, j), solid.kirchhoff()(i, j), 1e-14);  // a few roundings
  }
}

}  // namespace
}  // namespace mpm
