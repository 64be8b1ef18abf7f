/// Which particles a step takes for interior: those whose stencils end at no wall, for as far as
/// they may move before the next sort.

#include <mpm/parallel/session.hpp>
#include <mpm/shape/shapes.hpp>
#include <mpm/stepping/exchange.hpp>

#include <random>

#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Cells of side 1 m; walls on nodes 2 and nodes - 3 of every axis, particles between them.
template <int Dim>
struct WalledCloud {
  static constexpr int cells = Dim == 2 ? 40 : 26;
  static constexpr double lower = 2, upper = cells - 2;  // m, where walls stand
  Decomposition<Dim> decomposition{MPI_COMM_WORLD, geometry(), IndexVec<Dim>::Zero(), {}, {}};
  std::unique_ptr<Transfer<Dim>> transfer;
  std::vector<Body<Dim>> bodies;

  explicit WalledCloud(const std::string& shape)
      : transfer(make_transfer<Dim>(OneOf<ShapeRow>(shape), OneOf<SchemeRow>("flip"), {0.5}))
  {
    Body<Dim>& body = bodies.emplace_back(Body<Dim>{
        "cloud", 0, 1.0, nullptr,
        ParticleStore(transfer->motion_columns(true), {{"initial_volume", 1, "m3"}}, {})});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> between(lower, upper);
    for (GlobalIndex id = 0; id < 10000; ++id) {
      Vec<Dim> place;
      for (int d = 0; d < Dim; ++d) place[d] = between(random);
      if (decomposition.owner_of_cell(decomposition.geometry().cell_of(place)) !=
          rank_of(MPI_COMM_WORLD))
        continue;
      const LocalIndex p = body.particles.add(id);
      for (int d = 0; d < Dim; ++d) body.particles.motion()(d, p) = place[d];
    }
    body.particles.seal();
  }

  static GridGeometry<Dim> geometry()
  {
    GridGeometry<Dim> grid{Vec<Dim>::Zero(), Vec<Dim>::Ones(), IndexVec<Dim>::Constant(cells + 1)};
    grid.walls.fill({LocalIndex(lower), LocalIndex(upper)});
    return grid;
  }

  /// Interior particles over all ranks, and the one that stands nearest to a wall, m.
  std::pair<GlobalIndex, double> interior()
  {
    Exchange<Dim> exchange(decomposition, *transfer);
    exchange.sort(bodies);
    GlobalIndex count = 0;
    double nearest = cells;
    exchange.pass_and_sum(bodies, {}, {1, 0}, [&](const BodyPart<Dim>& part) {
      for (LocalIndex p = part.first * lane_count;
           part.interior && p < std::min(part.end * lane_count, part.body.particles.size()); ++p) {
        ++count;
        for (int d = 0; d < Dim; ++d) {
          const double x = part.body.particles.motion()(d, p);
          nearest = std::min({nearest, x - lower, upper - x});
        }
      }
      return PassOutcome<Dim>{};
    });
    sum_over_ranks(MPI_COMM_WORLD, std::span(&count, 1));
    MPI_Allreduce(MPI_IN_PLACE, &nearest, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    return {count, nearest};
  }
};

/// `reach`: of a shape function on either side, in cells.
template <int Dim>
void expect_interior_away_from_walls(const std::string& shape, double reach)
{
  const auto [count, nearest] = WalledCloud<Dim>(shape).interior();
  EXPECT_GT(count, 200) << shape;
  EXPECT_GE(nearest, reach + 1) << shape << ": one cell more, to move in";
  EXPECT_LT(nearest, reach + 2) << shape << ": but no more than a cell's rounding";
}

TEST(Interior, IsFartherFromWallsThanStencilsReachAndParticlesMove)
{
  expect_interior_away_from_walls<2>("gimp", 0.25);
  expect_interior_away_from_walls<2>("quadratic", 0.5);
  expect_interior_away_from_walls<2>("cubic", 1);
  expect_interior_away_from_walls<3>("quadratic", 0.5);
  expect_interior_away_from_walls<3>("cubic", 1);
}

TEST(Interior, GoesUpToWallsWhereShapeFunctionsDoNotEnd)
{
  EXPECT_LT(WalledCloud<2>("linear").interior().second, 0.1);
}

}  // namespace
}  // namespace mpm
