// A wall with the grip of contact: a one-sided potential of the particles that reach behind it.
#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/materials/hencky.hpp>

#include <gmock/gmock.h>

namespace mpm {
namespace {

constexpr double kappa = 0.5, density = 1000, mass = 3;
const Vec<2> size{0.5, 0.25};  // m, of a location

/// Particles in a row along an axis, more than one block of them.
Body<2> row_of(int axis, const std::vector<double>& places)
{
  auto law = make_hencky(PlaneAssumption::strain, {1e6, 0.3}, density, {});
  auto state = law->state_columns();
  Body<2> body{"row", 0, density, std::move(law),
               ParticleStore({{"position", 2, "m"}, {"velocity", 2, "m/s"}, {"mass", 1, "kg"}},
                             std::move(state), {"mass"})};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const LocalIndex p = body.particles.add(GlobalIndex(k));
    body.particles.motion()(axis, p) = places[k];
    body.particles.motion()(4, p) = mass;
  }
  body.particles.seal();
  return body;
}

/// On all particles along both axes, N.
std::vector<Vec<2>> pushes_of(RigidWall<2>& wall, const Body<2>& body, double time)
{
  std::vector<Vec<2>> forces(std::size_t(body.particles.size()), Vec<2>::Zero());
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
    Lanes force[2] = {0.0, 0.0};
    if (!wall.push(body, b, time, force)) continue;
    for (int lane = 0; lane < lane_count && b * lane_count + lane < body.particles.size(); ++lane)
      for (int d = 0; d < 2; ++d) forces[std::size_t(b * lane_count + lane)][d] = force[d][lane];
  }
  return forces;
}

class PushingWall : public testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  const int axis = std::get<0>(GetParam());
  const bool upper = std::get<1>(GetParam());
  const double towards = upper ? -1 : 1;  ///< the body
  /// Places of particles whose faces are so far behind a face at 1 m.
  std::vector<double> places_of(const std::vector<double>& depths) const
  {
    std::vector<double> places;
    for (const double depth : depths) places.push_back(1 - towards * (depth - 0.5 * size[axis]));
    return places;
  }
  RigidWall<2> wall{{axis, upper, 1.0},
                    WallMotion{.speed = -2 * towards},
                    WallGrip::contact,
                    ReactionBook::increments,
                    {kappa, size}};
};

TEST_P(PushingWall, PushesWithTheModulusTimesTheDepthAndNeverPulls)
{
  const std::vector<double> depths{-0.3, -1e-9, 0, 0.02, 0.1, 0.4, -2, 0.01, 0.03, 0.05, -0.1};
  const Body<2> body = row_of(axis, places_of(depths));
  const std::vector<Vec<2>> forces = pushes_of(wall, body, 0);
  const double modulus = density * std::pow(body.law->wave_speed(), 2);
  for (std::size_t k = 0; k < depths.size(); ++k) {
    // kappa C d / s on the face of a location of this mass.
    const double face = mass / density / size[axis];
    const double expected = depths[k] > 0 ? kappa * modulus * depths[k] / size[axis] * face : 0;
    EXPECT_NEAR(forces[k][axis], towards * expected, 1e-8 * modulus);
    EXPECT_EQ(forces[k][1 - axis], 0);
  }
}

TEST_P(PushingWall, IsTheDerivativeOfWhatItStores)
{
  constexpr double step = 1e-6;
  const Body<2> here = row_of(axis, places_of({0.05, 0.11}));
  const Body<2> there = row_of(axis, places_of({0.05 + step, 0.11}));
  const Body<2> middle = row_of(axis, places_of({0.05 + 0.5 * step, 0.11}));
  const double gained = wall.stored(there, 0).energy - wall.stored(here, 0).energy;
  const double force = towards * pushes_of(wall, middle, 0)[0][axis];
  EXPECT_NEAR(gained / step, force, 1e-6 * force);  // a difference of nine digits less six
  const ContactSums sums = wall.stored(here, 0);
  EXPECT_EQ(sums.pairs, 2);
  EXPECT_NEAR(sums.overlapped_area, 0.16 * size[1 - axis], 1e-12);
  EXPECT_NEAR(sums.deepest_overlap, 0.11 / size[axis], 1e-12);
}

TEST_P(PushingWall, BooksImpulseAndTheWorkOfItsFaceOnce)
{
  const Body<2> body = row_of(axis, places_of({0.05, 0.11}));
  wall.reset_push();
  double force = 0;
  for (const Vec<2>& f : pushes_of(wall, body, 0)) force += f[axis];
  wall.book_push(0, 0.1);
  wall.reset_push();
  wall.book_push(0.1, 0.1);
  const Reaction<2> reaction = wall.take_reaction();
  EXPECT_DOUBLE_EQ(reaction.impulse[axis], 0.1 * force);
  EXPECT_DOUBLE_EQ(reaction.work, 0.1 * force * -2 * towards);
  EXPECT_EQ(reaction.impulse[1 - axis], 0);
}

INSTANTIATE_TEST_SUITE_P(AxesAndEnds, PushingWall,
                         testing::Combine(testing::Values(0, 1), testing::Bool()));

}  // namespace
}  // namespace mpm
