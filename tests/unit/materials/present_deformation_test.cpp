#include <mpm/materials/hypoelastic_solid.hpp>
#include <mpm/materials/present_deformation.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// Particles with these volume ratios.
Body<3> body_of(const std::vector<double>& ratios)
{
  auto law = make_hypoelastic_solid({1e9, 0.3}, 1000, std::nullopt);
  ParticleStore particles({}, law->state_columns(), {"initial_volume"});
  Body<3> body{"block", 0, 1000, std::move(law), std::move(particles)};
  ColumnGroup& state = body.particles.state();
  for (const double ratio : ratios) {
    const LocalIndex p = body.particles.add(0);
    state(0, p) = 1;
    state(state.find("volume_ratio"), p) = ratio;
  }
  body.particles.seal();
  return body;
}

std::optional<BeyondBounds> find_beyond_bounds(const Body<3>& body)
{
  return present_deformation(body).beyond_bounds;
}

TEST(DeformationBounds, FirstParticleBeyondThemIsFound)
{
  EXPECT_FALSE(find_beyond_bounds(body_of({0.0101, 1, 99})));
  const auto crushed = find_beyond_bounds(body_of({1, 1, 0.0099, 200}));
  ASSERT_TRUE(crushed);
  EXPECT_EQ(crushed->particle, 2);
  EXPECT_EQ(crushed->volume_ratio, 0.0099);
  EXPECT_EQ(find_beyond_bounds(body_of({101}))->particle, 0);
  EXPECT_EQ(find_beyond_bounds(body_of(std::vector<double>(20, 1))), std::nullopt);
}

TEST(DeformationBounds, WhatIsNoNumberIsBeyondThem)
{
  const auto found = find_beyond_bounds(body_of({1, 1, 1, 1, 1, 1, 1, 1, 1, std::nan("")}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->particle, 9);
}

}  // namespace
}  // namespace mpm
