#include <mpm/conditions/surface_place.hpp>
#include <mpm/transfer/transfer.hpp>

#include <cmath>

#include <gmock/gmock.h>

namespace mpm {
namespace {

TEST(SurfacePlace, IsWhereARowOfParticlesEnds)
{
  for (const char* shape : {"linear", "gimp", "quadratic", "cubic", "cpdi"})
    for (const int per_cell : {1, 2, 3}) {
      const double size = 1.0 / per_cell;
      const auto transfer =
          make_transfer<2>(OneOf<ShapeRow>(shape), OneOf<SchemeRow>("flip"), {size});
      const auto weight = [&](double x) { return transfer->weight_along(x, size); };
      const SurfacePlace place(weight, size);
      for (const double surface : {-0.7, -0.31, -0.1, 0.0, 0.2, 0.45}) {
        double mass = 0, moment = 0;
        for (int k = 0; k < 20; ++k) {
          const double x = surface - (k + 0.5) * size;
          mass += weight(x);
          moment += weight(x) * x;
        }
        if (mass < 1e-3) continue;
        // The table's lines are straight over a 64th of a cell.
        EXPECT_NEAR(place.from_mean(moment / mass), surface, 0.01) << shape << per_cell;
      }
    }
}

TEST(SurfacePlace, GoesOnToTheEndsOfWhatANodeFeels)
{
  const SurfacePlace place([](double x) { return std::max(0.0, 1 - std::abs(x)); }, 0.5);
  EXPECT_GE(place.from_mean(0.0), 0.74);    // the last particle that it feels is there
  EXPECT_LE(place.from_mean(-1.5), -1.25);  // its nearest particle is out of reach
}

}  // namespace
}  // namespace mpm
