// Bodies of location cells that fly, turn, are crushed and meet, on any ranks.
#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/core/error.hpp>
#include <mpm/core/memory_archive.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/load_balance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "other_borders.hpp"
#include "ragged_blocks.hpp"
#include "sums_of_bodies.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

constexpr double cell = 1e-3, youngs_modulus = 1e9, density = 1000;
const Vec<2> size(0.5e-3, 0.5e-3);
const IndexVec<2> grid_cells(24, 16);

/// Three in a row and two rows for six ranks, so that corners are crossed.
IndexVec<2> two_rows()
{
  const int ranks = ranks_of(MPI_COMM_WORLD);
  return ranks % 2 == 0 ? IndexVec<2>(ranks / 2, 2) : IndexVec<2>(ranks, 1);
}

Decomposition<2> shared_out(MPI_Comm comm, bool periodic = false)
{
  GridGeometry<2> geometry{Vec<2>::Zero(), Vec<2>::Constant(cell),
                           (grid_cells.array() + 1).matrix()};
  if (periodic) {
    geometry.nodes[1] = grid_cells[1];
    geometry.periodic[1] = true;
  }
  const bool alone = ranks_of(comm) == 1;
  return {comm, geometry, alone ? IndexVec<2>(1, 1) : two_rows(), {}, {}};
}

/// A ring of a wall two locations thick with a bar in it, in one piece: lumens that fold.
bool is_wall(int i, int j)
{
  return i < 2 || i >= 22 || j < 2 || j >= 18 || (i >= 11 && i < 13);
}

/// A U of two long legs of the same thickness, 36 locations apart.
bool is_hairpin(int i, int j)
{
  return j < 2 || i < 2 || i >= 38;
}

struct Scene {
  int first_x = 6, first_y = 6;  ///< locations
  Vec<2> velocity = Vec<2>::Zero();
  double turning = 0;  ///< rad/s about its middle
  std::optional<YieldConstants> yield{};
  bool pressed = false;  ///< between two walls that come together
  double friction = 0;   ///< on these walls
  bool periodic = false;
  bool fitted = false;  ///< corners stand beside the lattice at rest
  /// m/s, of the tips of a hairpin's legs towards each other; 0: a ring.
  double folding = 0;
};

/// Of every corner of the lattice, up to a third of a location; alike at both ends of a period.
CornerOffsets<2> offsets_of_all()
{
  CornerOffsets<2> offsets;
  for_each_index(IndexBox<2>{IndexVec<2>::Zero(), 2 * grid_cells + IndexVec<2>::Constant(1)},
                 [&](const IndexVec<2>& at) {
                   const double phase = 2 * 3.14159265358979 * at[1] / (2 * grid_cells[1]);
                   offsets.add(at, {0.3 * size[0] * std::sin(5 * phase + at[0]),
                                    0.3 * size[1] * std::cos(7 * phase + 2 * at[0])});
                 });
  offsets.seal();
  return offsets;
}

constexpr double wall_speed = 40;

class Ring {
 public:
  Ring(MPI_Comm comm, const Scene& scene) : comm_(comm)
  {
    const Decomposition<2> decomposition = shared_out(comm, scene.periodic);
    TotalLagrangian<2>::Setup setup{
        .bodies = {}, .location_size = size, .contact_stiffness = 4, .mass_scaling = 0.3};
    auto law = make_hencky(PlaneAssumption::strain, {youngs_modulus, 0.3}, density, scene.yield);
    ParticleStore store(LocationCells<2>::columns(*law, scene.fitted), law->state_columns(),
                        {"velocity", "mass", "initial_volume", "plastic_work"});
    setup.bodies.push_back({"ring", 0, density, std::move(law), std::move(store)});
    Body<2>& body = setup.bodies.back();
    const bool folds = scene.folding > 0;
    const int wide = folds ? 40 : 24, high = folds ? 26 : 20;
    const Vec<2> middle(12 * size[0], 10 * size[1]);
    GlobalIndex id = 0;
    for (int j = 0; j < high; ++j)
      for (int i = 0; i < wide; ++i) {
        if (!(folds ? is_hairpin(i, j) : is_wall(i, j))) continue;
        const GlobalIndex number = id++;
        const IndexVec<2> at(scene.first_x + i, (scene.first_y + j) % 32);
        const IndexVec<2> home(at[0] / 2, at[1] / 2);
        if (decomposition.owner_of_cell(home) != decomposition.rank()) continue;
        const LocalIndex p = body.particles.add(number);
        ColumnGroup& motion = body.particles.motion();
        const Vec<2> from_middle((i + 0.5) * size[0] - middle[0], (j + 0.5) * size[1] - middle[1]);
        const std::array<double, 5> values{(at[0] + 0.5) * size[0], (at[1] + 0.5) * size[1],
                                           scene.velocity[0] - scene.turning * from_middle[1] +
                                               scene.folding * j / high * (i < wide / 2 ? 1 : -1),
                                           scene.velocity[1] + scene.turning * from_middle[0],
                                           density * size.prod()};
        for (int c = 0; c < 5; ++c) motion(c, p) = values[std::size_t(c)];
        LocationCells<2>::initialise(motion, p);
        body.particles.state()(0, p) = size.prod();
        body.law->initialise(body.particles.state(), p);
      }
    body.particles.seal();
    cells_ = id;
    if (scene.pressed)
      for (const bool upper : {false, true}) {
        const double room = scene.fitted ? 0.3 : 0;  // corners stand beyond the lattice there
        const double face = (scene.first_x + (upper ? 24 + room : -room)) * size[0];
        setup.slots.conditions.push_back(std::make_unique<RigidWall<2>>(
            WallPlacement{0, upper, face}, WallMotion{upper ? -wall_speed : wall_speed, 0},
            WallGrip::contact, ReactionBook{}, WallStiffness<2>{}, scene.friction));
      }
    if (scene.fitted) setup.offsets = offsets_of_all();
    stepper_ = std::make_unique<TotalLagrangian<2>>(decomposition, std::move(setup));
  }

  TotalLagrangian<2>& stepper() { return *stepper_; }
  void advance(int steps)
  {
    const double wave = stepper_->bodies().front().law->wave_speed();
    for (int k = 0; k < steps; ++k) stepper_->step(0.1 * size[0] / wave);
    stepper_->check();
  }

  using Found = SumsOfBodies<2>;
  /// Collective.
  Found found() { return {comm_, *stepper_, cells_}; }
  /// What this rank counts, by grid cell.
  std::vector<double> work() const
  {
    std::vector<double> work(std::size_t(grid_cells.prod()));
    stepper_->visit_work([&](const IndexVec<2>& at, double amount) {
      work[std::size_t(at[0] + grid_cells[0] * at[1])] += amount;
    });
    return work;
  }
  double mass() const { return double(cells_) * density * size.prod(); }

 private:
  MPI_Comm comm_;
  GlobalIndex cells_ = 0;
  std::unique_ptr<TotalLagrangian<2>> stepper_;
};

TEST(TotalLagrangian, FliesWithoutEffect)
{
  Ring run(MPI_COMM_WORLD, {.velocity = {30, -20}});
  const Ring::Found before = run.found();
  run.advance(200);
  const Ring::Found after = run.found();
  EXPECT_NEAR(after.energy / before.energy, 1, 1e-12);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm());
  for (std::size_t k = 0; k < before.places.size(); ++k)
    ASSERT_NEAR(after.places[k] - before.places[k], run.stepper().time() * (k % 2 == 0 ? 30 : -20),
                1e-14);
}

TEST(TotalLagrangian, TurnsAndSwingsAndKeepsEnergyAndMomentum)
{
  Ring run(MPI_COMM_WORLD, {.velocity = {5, 0}, .turning = 8000});
  const Ring::Found before = run.found();
  run.advance(4000);  // more than half a turn
  const Ring::Found after = run.found();
  EXPECT_NEAR(after.energy / before.energy, 1, 2e-3);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-11 * before.momentum.norm());
}

/// Pressed until the lumens are closed: what the walls do is what is stored, dissipated and moving.
TEST(TotalLagrangian, IsCrushedWithAClosedBalanceOnAnyRanks)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true};
  Ring together(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  // Until paths of buckling part, what ranks do together is what one does alone.
  together.advance(1000);
  alone.advance(1000);
  EXPECT_LT(largest_difference(together.found().places, alone.found().places), 1e-9 * cell);
  double work = 0;
  Vec<2> impulse = Vec<2>::Zero();
  Ring::Found now = together.found();
  const Ring::Found first = now;
  for (int k = 0; k < 8; ++k) {
    together.advance(220);
    now = together.found();
    work += now.work;
    impulse += now.impulse;
  }
  EXPECT_GT(now.pairs, 40);
  EXPECT_LT(now.overlapped, 0.01 * together.mass() / density);
  EXPECT_NEAR((now.energy - first.energy) / work, 1, 5e-3);
  EXPECT_LT((now.momentum - first.momentum - impulse).norm(),
            1e-13 * std::sqrt(2 * now.energy * together.mass()));
}

TEST(TotalLagrangian, CrushesCellsOfAnyShapeOnAnyRanks)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true, .fitted = true};
  Ring together(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  const Ring::Found first = together.found();
  EXPECT_LT(largest_difference(first.places, alone.found().places), 1e-15);
  EXPECT_NEAR(first.energy, 0, 1e-20);
  together.advance(600);
  alone.advance(600);
  const Ring::Found now = together.found();
  EXPECT_LT(largest_difference(now.places, alone.found().places), 1e-9 * cell);
  EXPECT_NEAR((now.energy - first.energy) / now.work, 1, 5e-3);
}

/// Legs at either end of the specimen, on ranks that have no border in common where there are three
/// in a row, meet with their tips.
TEST(TotalLagrangian, FoldsPartsTogetherThatWereMoreThanHalfASpecimenApartOnAnyRanks)
{
  const Scene scene{.first_x = 4, .first_y = 3, .yield = YieldConstants{30e6, 0}, .folding = 120};
  Ring together(MPI_COMM_WORLD, scene), alone(MPI_COMM_SELF, scene);
  for (int k = 0; k < 20 && alone.found().pairs == 0; ++k) {
    EXPECT_EQ(together.found().pairs, 0);
    together.advance(200);
    alone.advance(200);
  }
  together.advance(100);
  alone.advance(100);
  const Ring::Found one = alone.found(), now = together.found();
  EXPECT_GT(one.pairs, 0);
  EXPECT_EQ(now.pairs, one.pairs);
  EXPECT_NEAR(now.energy / one.energy, 1, 1e-9);
  EXPECT_LT(largest_difference(now.places, one.places), 1e-9 * cell);
}

TEST(TotalLagrangian, TakesUpWhatWasSavedToTheLastBit)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true, .friction = 0.3};
  Ring run(MPI_COMM_WORLD, scene), other(MPI_COMM_WORLD, scene);
  run.advance(1510);
  MemoryArchive archive;
  archive.start_saving();
  run.stepper().archive(archive);
  archive.start_loading();
  other.stepper().archive(archive);
  EXPECT_TRUE(archive.unread().empty());
  // Though one has listed its pairs long ago, and the other just now.
  EXPECT_EQ(other.work(), run.work());
  run.advance(430);
  other.advance(430);
  const Ring::Found one = run.found(), two = other.found();
  EXPECT_EQ(one.places, two.places);
  EXPECT_EQ(one.energy, two.energy);
  const double rubbed = run.stepper().carried().contact->friction_work;
  EXPECT_EQ(rubbed, other.stepper().carried().contact->friction_work);
  double all = rubbed;
  sum_over_ranks(MPI_COMM_WORLD, std::span(&all, 1));
  EXPECT_GT(all, 0);
}

/// Cells that touch, flow and rub go to other ranks, near and far, and back.
TEST(TotalLagrangian, GoesOnAlikeWhereBordersMove)
{
  for (const auto& [periodic, fitted] : {std::pair(false, false), std::pair(true, false),
                                         std::pair(false, true), std::pair(true, true)}) {
    const Scene scene{.first_y = periodic ? 20 : 6,
                      .yield = YieldConstants{30e6, 0},
                      .pressed = true,
                      .friction = 0.3,
                      .periodic = periodic,
                      .fitted = fitted};
    Ring moved(MPI_COMM_WORLD, scene), still(MPI_COMM_WORLD, scene);
    const Ownership<2> first = moved.stepper().decomposition().ownership();
    ASSERT_TRUE(moved.stepper().can_repartition());
    still.advance(1000);
    moved.advance(600);
    GlobalIndex left = 0;
    for (const unsigned seed : {1u, 2u}) {
      left +=
          moved.stepper().repartition(scattered_blocks(first.geometry(), 3, first.ranks(), seed));
      moved.advance(100);
    }
    moved.stepper().repartition(first);
    moved.advance(200);
    sum_over_ranks(MPI_COMM_WORLD, std::span(&left, 1));
    EXPECT_EQ(left > 0, first.ranks() > 1);
    const Ring::Found one = still.found(), now = moved.found();
    EXPECT_EQ(now.pairs, one.pairs);
    EXPECT_NEAR(now.energy / one.energy, 1, 1e-9);
    EXPECT_NEAR(now.work / one.work, 1, 1e-9);
    EXPECT_LT(largest_difference(now.places, one.places), 1e-9 * cell);
  }
}

/// Lumens that are pressed flat cost more than the rest: the borders between ranks follow.
TEST(TotalLagrangian, SharesOutTheWorkOfContact)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true};
  Ring moved(MPI_COMM_WORLD, scene), still(MPI_COMM_WORLD, scene);
  LoadBalance<2> balance({}, 0);
  std::optional<double> before_move;
  double saved = 0, after_moves = 0;
  int moves_seen = 0;
  for (int check = 0; check < 140; ++check) {
    still.advance(20);
    moved.advance(20);
    const double imbalance = moved.stepper().agreed().work_imbalance();
    if (before_move) {
      saved += *before_move - imbalance;
      after_moves += imbalance;
      ++moves_seen;
    }
    const GlobalIndex moves = balance.repartitions();
    balance.look(moved.stepper());
    before_move.reset();
    if (balance.repartitions() > moves) before_move = imbalance;
  }
  // As moves promise: ten steps of work within a thousand. Of a single one a fold that closes
  // within the next twenty steps can take more.
  EXPECT_GE(saved, 0.01 * moves_seen);
  const Ring::Found one = still.found(), now = moved.found();
  EXPECT_GT(one.pairs, 100);
  EXPECT_NEAR(now.energy / one.energy, 1, 1e-3);
  const double before = still.stepper().agreed().work_imbalance(),
               after = moved.stepper().agreed().work_imbalance();
  if (ranks_of(MPI_COMM_WORLD) == 1) {
    EXPECT_EQ(balance.repartitions(), 0);
    return;
  }
  ASSERT_GT(moves_seen, 0);
  // A column of cells is a twelfth of a rank's work, with six of them.
  EXPECT_LT(after_moves / moves_seen, 1 + 1.0 / 12);
  EXPECT_LT(after - 1, 0.5 * (before - 1));
}

TEST(TotalLagrangian, TakesUpWhatWasSavedWithinOtherBorders)
{
  const Scene scene{.yield = YieldConstants{30e6, 0}, .pressed = true, .friction = 0.3};
  Ring run(MPI_COMM_WORLD, scene), anew(MPI_COMM_WORLD, scene);
  expect_taken_up_within_other_borders(run, anew, {.before = 300, .compared = 100, .astray = 60});
}

TEST(TotalLagrangian, GoesOnAcrossAPeriodicSide)
{
  const Scene inside{.first_y = 6, .turning = 500, .periodic = true};
  Scene across = inside;
  across.first_y = 20;  // its upper half comes in from below
  Ring one(MPI_COMM_WORLD, inside), two(MPI_COMM_WORLD, across);
  one.advance(300);
  two.advance(300);
  const Ring::Found a = one.found(), b = two.found();
  EXPECT_NEAR(b.energy / a.energy, 1, 1e-12);
  const double period = grid_cells[1] * cell, shift = 14 * size[1];
  for (std::size_t k = 0; k < a.places.size(); ++k) {
    double apart = b.places[k] - a.places[k] - (k % 2 == 1 ? shift : 0.0);
    if (k % 2 == 1) apart -= period * std::round(apart / period);
    ASSERT_NEAR(apart, 0, 1e-10 * cell) << k;
  }
}

TEST(TotalLagrangian, NamesACellThatIsTurnedInsideOut)
{
  Ring run(MPI_COMM_WORLD, {.turning = 4e6});
  try {
    run.advance(400);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("of body 'ring'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mpm
