/// Bodies on grids that begin again where they end: nothing tells where the seam is.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}

/// Cells of 1/64 m between 1 and 2 m: coordinates there have one and the same rounding, and half a
/// period is a whole number of it, so that what is shifted by it keeps its bits.
constexpr LocalIndex around = 64;
constexpr double h = 1.0 / around;

template <int Dim>
GridGeometry<Dim> ring(const IndexVec<Dim>& nodes, std::array<bool, Dim> periodic)
{
  return {Vec<Dim>::Ones(), Vec<Dim>::Constant(h), nodes, periodic};
}

/// Two particles per cell and axis fill the cells [lower, upper); E and density make the speed of
/// sound about 1 m/s.
template <int Dim>
Body<Dim> filled(const Decomposition<Dim>& decomposition, const Transfer<Dim>& transfer,
                 const IndexBox<Dim>& cells, const std::function<Vec<Dim>(const Vec<Dim>&)>& speed)
{
  constexpr IsotropicConstants elastic{1000.0, 0.25};
  constexpr double density = 1000;
  std::unique_ptr<Law<Dim>> law;
  if constexpr (Dim == 2)
    law = make_hencky(PlaneAssumption::strain, elastic, density, {});
  else
    law = make_hencky_solid(elastic, density, {});
  auto state = law->state_columns();
  ParticleStore particles(transfer.motion_columns(true), std::move(state),
                          {"velocity", "mass", "grid_velocity", "initial_volume"});
  Body<Dim> body{"ring", 0, density, std::move(law), std::move(particles)};
  const double volume = std::pow(0.5 * h, Dim);
  GlobalIndex id = 0;
  for_each_index(IndexBox<Dim>{2 * cells.lower, 2 * cells.upper}, [&](const IndexVec<Dim>& at) {
    const GlobalIndex own = id++;
    const IndexVec<Dim> cell = at / 2;
    if (decomposition.owner_of_cell(cell) != decomposition.rank()) return;
    const LocalIndex p = body.particles.add(own);
    ColumnGroup& motion = body.particles.motion();
    Vec<Dim> place;
    for (int d = 0; d < Dim; ++d) place[d] = 1 + (0.25 + 0.5 * at[d]) * h;
    const Vec<Dim> v = speed(place);
    for (int d = 0; d < Dim; ++d) {
      motion(d, p) = place[d];
      motion(Dim + d, p) = v[d];
    }
    motion(2 * Dim, p) = density * volume;
    set_domain_at_rest<Dim>(motion, p, Vec<Dim>::Constant(0.25 * h));
    body.particles.state()(0, p) = volume;
    body.law->initialise(body.particles.state(), p);
  });
  body.particles.seal();
  return body;
}

template <int Dim>
std::unique_ptr<UpdatedLagrangian<Dim>> stepper(
    const Decomposition<Dim>& decomposition, OneOf<ShapeRow> shape, const IndexBox<Dim>& cells,
    const std::function<Vec<Dim>(const Vec<Dim>&)>& speed)
{
  typename UpdatedLagrangian<Dim>::Setup setup;
  setup.transfer = make_transfer<Dim>(shape, "flip", {0.5});
  setup.order = "musl";
  setup.bodies.push_back(filled(decomposition, *setup.transfer, cells, speed));
  setup.mass_cut = 1e-20;
  return std::make_unique<UpdatedLagrangian<Dim>>(decomposition, std::move(setup));
}

/// Position, velocity and stress xx of every particle of all ranks, by id. Collective.
template <int Dim>
std::vector<double> gather(const UpdatedLagrangian<Dim>& stepper, std::size_t particles)
{
  constexpr std::size_t width = 2 * Dim + 1;
  std::vector<double> values(width * particles, 0.0);
  alignas(lane_alignment) double stress[6 * lane_count];
  for (const Body<Dim>& body : stepper.bodies())
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      double* of = &values[width * std::size_t(body.particles.ids()[p])];
      for (int c = 0; c < 2 * Dim; ++c) of[c] = body.particles.motion()(c, p);
      body.law->cauchy_stress(body.particles.state().block(p / lane_count), stress);
      of[2 * Dim] = stress[p % lane_count];
    }
  sum_over_ranks(MPI_COMM_WORLD, values);
  return values;
}

/// A bar of one cell between slipping walls, with a pulse of eight cells that runs both ways from
/// cell `middle`. With linear functions and one row of cells every node gets two terms, so that the
/// order of the sum, and with it the number of ranks, cannot matter.
std::vector<double> pulse(LocalIndex middle, int steps)
{
  const GridGeometry<2> geometry = ring<2>({around, 6}, {true, false});
  const Decomposition<2> decomposition(MPI_COMM_WORLD, geometry, {ranks(), 1}, {}, {});
  const auto speed = [middle](const Vec<2>& place) -> Vec<2> {
    // In half cells, from the pulse's middle, the shorter way around.
    double from = 2 * around * (place[0] - 1) - 2 * middle;
    from -= 2 * around * std::round(from / (2 * around));
    const double s = std::abs(from) < 8 ? 1 + std::cos(std::numbers::pi * from / 8) : 0.0;
    return {1e-3 * s, 0};
  };
  auto run = stepper<2>(decomposition, "linear", {{0, 2}, {around, 3}}, speed);
  for (const bool upper : {false, true})
    run->slots().conditions.push_back(
        std::make_unique<RigidWall<2>>(WallPlacement{1, upper, 1 + (upper ? 3 : 2) * h},
                                       WallMotion{}, WallGrip::slip, ReactionBook::increments));
  for (int step = 0; step < steps; ++step) run->step(0.25 * h);
  run->check();
  return gather(*run, 4 * around);
}

TEST(PeriodicBar, PulseCrossesTheSeamWithTheBitsThatItHasInTheMiddle)
{
  constexpr int steps = 96;  // the pulse's halves run 24 cells each way
  const std::vector<double> in_the_middle = pulse(around / 2, steps), at_the_seam = pulse(0, steps);
  double largest = 0, farthest = 0;
  int different = 0;
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t i = 0; i < 2 * around; ++i) {
      const double* a = &in_the_middle[5 * (2 * around * row + i)];
      const double* b = &at_the_seam[5 * (2 * around * row + (i + around) % (2 * around))];
      for (const int c : {1, 2, 3, 4}) different += a[c] != b[c];
      different += a[0] - std::floor(2 * a[0]) / 2 != b[0] - std::floor(2 * b[0]) / 2;
      largest = std::max(largest, std::abs(a[4]));
      if (std::abs(a[2]) > 1e-4) farthest = std::max(farthest, std::abs(i - 1.0 * around));
    }
  EXPECT_EQ(different, 0);
  EXPECT_GT(largest, 0.1) << "Pa: there is a pulse";
  EXPECT_GT(farthest, 40) << "half cells: it has run";
}

/// A full ring of particles in space that moves along its diagonal: twice around and more.
template <int Dim>
void expect_to_come_around(const Decomposition<Dim>& decomposition, OneOf<ShapeRow> shape,
                           const IndexBox<Dim>& cells)
{
  Vec<Dim> velocity = Vec<3>(0.5, 0.3, 0.2).head<Dim>();
  for (int d = 0; d < Dim; ++d)
    if (!decomposition.geometry().periodic[d]) velocity[d] = 0;
  auto run = stepper<Dim>(decomposition, shape, cells, [&](const Vec<Dim>&) { return velocity; });
  const std::size_t particles = std::size_t(cells.size()) << Dim;
  const std::vector<double> before = gather(*run, particles);
  constexpr int steps = 600;
  const double dt = 0.3 * h;  // 90 cells along x
  for (int step = 0; step < steps; ++step) run->step(dt);
  run->check();
  const std::vector<double> after = gather(*run, particles);
  GlobalIndex held = run->particles();
  sum_over_ranks(MPI_COMM_WORLD, std::span(&held, 1));
  EXPECT_EQ(held, GlobalIndex(particles));
  double error = 0, stress = 0;
  const GridGeometry<Dim>& geometry = decomposition.geometry();
  for (std::size_t k = 0; k < particles; ++k) {
    for (int d = 0; d < Dim; ++d) {
      const double* of = &after[(2 * Dim + 1) * k];
      double away = of[d] - before[(2 * Dim + 1) * k + d] - velocity[d] * dt * steps;
      if (geometry.periodic[d]) {
        away -= geometry.period(d) * std::round(away / geometry.period(d));
        EXPECT_GE(of[d], geometry.origin[d]);
        EXPECT_LE(of[d], geometry.origin[d] + geometry.period(d));
      }
      error = std::max(error, std::abs(away));
      EXPECT_NEAR(of[Dim + d], velocity[d], 1e-12);
    }
    stress = std::max(stress, std::abs(after[(2 * Dim + 1) * k + 2 * Dim]));
  }
  EXPECT_LT(error, 1e-12);  // rounding of some hundred additions to coordinates of 1 to 2
  EXPECT_LT(stress, 1e-8);  // of a modulus of 1000 Pa: rounding of v / h makes the only strain
}

TEST(PeriodicGrid, FullPlaneMovesThroughBothSeamsOnAnyMapOfOwners)
{
  const IndexVec<2> cells(18, 14);
  const GridGeometry<2> geometry = ring<2>(cells, {true, true});
  const IndexVec<2> wish = ranks() % 2 == 0 ? IndexVec<2>(ranks() / 2, 2) : IndexVec<2>(ranks(), 1);
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>())
    expect_to_come_around<2>({MPI_COMM_WORLD, geometry, wish, {}, {}}, shape, {{0, 0}, cells});
  expect_to_come_around<2>({MPI_COMM_WORLD, metis_blocks(geometry, ranks())}, "gimp",
                           {{0, 0}, cells});
}

TEST(PeriodicGrid, FullSpaceMovesThroughAllSeams)
{
  const IndexVec<3> cells(12, 8, 7);
  const GridGeometry<3> geometry = ring<3>(cells, {true, true, true});
  // 2 x 2 x 2, 3 x 2 x 2: eight ranks meet in every corner.
  const IndexVec<3> wish =
      ranks() % 4 == 0 ? IndexVec<3>(ranks() / 4, 2, 2) : IndexVec<3>(ranks(), 1, 1);
  for (const OneOf<ShapeRow> shape : all_of_list<ShapeRow>())
    expect_to_come_around<3>({MPI_COMM_WORLD, geometry, wish, {}, {}}, shape, {{0, 0, 0}, cells});
}

TEST(PeriodicGrid, BlockFliesThroughTheSeamBetweenFreeSides)
{
  const GridGeometry<2> geometry = ring<2>({24, 40}, {true, false});
  const IndexBox<2> block{{2, 4}, {10, 10}};
  expect_to_come_around<2>({MPI_COMM_WORLD, geometry, {0, 0}, {}, {}}, "gimp", block);
}

}  // namespace
}  // namespace mpm
