#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/migration.hpp>
#include <mpm/parallel/redistribution.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/transfer/scheme.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <thread>

#include "ragged_blocks.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}
int rank()
{
  return rank_of(MPI_COMM_WORLD);
}

/// Where a particle is in a round, in cells; the same on every rank, so that each knows what to
/// expect without asking.
template <int Dim>
using Path = std::function<Vec<Dim>(GlobalIndex id, int round)>;

/// Far from one round to the next, and anywhere on the grid.
template <int Dim>
Path<Dim> random_jumps(const IndexVec<Dim>& cells)
{
  return [cells](GlobalIndex id, int round) {
    std::mt19937 draw(unsigned(7919 * id + round));
    Vec<Dim> place;
    for (int d = 0; d < Dim; ++d)
      place[d] = std::uniform_real_distribution<double>(0, cells[d])(draw);
    return place;
  };
}

/// Along the diagonal by most of a cell a round, in again on the other side.
template <int Dim>
Path<Dim> diagonal_drift(const IndexVec<Dim>& cells)
{
  return [cells](GlobalIndex id, int round) {
    Vec<Dim> place;
    for (int d = 0; d < Dim; ++d)
      place[d] = std::fmod(0.61 * double(id) * (d + 1) + 0.83 * round, double(cells[d]));
    return place;
  };
}

/// Along the diagonal by most of a cell a round, and back from the sides: never farther than a step
/// may go.
template <int Dim>
Path<Dim> bouncing(const IndexVec<Dim>& cells)
{
  return [cells](GlobalIndex id, int round) {
    Vec<Dim> place;
    for (int d = 0; d < Dim; ++d) {
      const double way = std::fmod(0.61 * double(id) * (d + 1) + 0.83 * round, 2.0 * cells[d]);
      place[d] = std::min(way < cells[d] ? way : 2 * cells[d] - way, cells[d] - 1e-9);
    }
    return place;
  };
}

/// Nobody but the first and the last rank ever has particles: all between are skipped.
Path<2> corner_to_corner(const IndexVec<2>& cells)
{
  return [cells](GlobalIndex id, int round) -> Vec<2> {
    const double inside = 0.1 + 0.8 * double(id % 10) / 10;
    if ((id + round) % 2 == 0) return Vec<2>(inside, inside);
    return Vec<2>(cells[0] - inside, cells[1] - inside);
  };
}

/// Value of a column that names its particle and itself, without rounding.
double signature(GlobalIndex id, int column)
{
  return double(1000 * id + column) + 0.5;
}

/// Bodies on a grid of cells of side 1 m, moved along a path and checked after each exchange.
template <int Dim>
class Cloud {
 public:
  Cloud(const IndexVec<Dim>& cells, const IndexVec<Dim>& wish, Path<Dim> path)
      : Cloud({MPI_COMM_WORLD, grid_of(cells), wish, {}, {}}, std::move(path))
  {
  }
  Cloud(const Decomposition<Dim>& decomposition, Path<Dim> path)
      : decomposition_(decomposition),
        halo_(decomposition_, support),
        migration_(decomposition_, support, halo_.neighbours()),
        grid_(decomposition_.geometry(), decomposition_.local(rank(), support),
              owned_nodes(decomposition_, support), 0),
        path_(std::move(path))
  {
  }

  static GridGeometry<Dim> grid_of(const IndexVec<Dim>& cells)
  {
    return {Vec<Dim>::Zero(), Vec<Dim>::Ones(), (cells.array() + 1).matrix()};
  }

  void add_body(GlobalIndex first_id, int particles, std::vector<Column> motion,
                std::vector<Column> state)
  {
    Body<Dim>& body = bodies_.emplace_back(
        Body<Dim>{"cloud", int(bodies_.size()), 1.0, nullptr,
                  ParticleStore(std::move(motion), std::move(state), {"mass", "initial_volume"})});
    counts_.push_back(particles);
    first_ids_.push_back(first_id);
    for (GlobalIndex id = first_id; id < first_id + particles; ++id) {
      if (owner(id, 0) != rank()) continue;
      const LocalIndex p = body.particles.add(id);
      for (int c = 0; c < body.particles.motion().width(); ++c)
        body.particles.motion()(c, p) = signature(id, c);
      for (int c = 0; c < body.particles.state().width(); ++c)
        body.particles.state()(c, p) = signature(id, 100 + c);
      put(body, p, 0);
    }
    body.particles.seal();
  }

  /// To any place on the grid.
  Redistributed move_to(int round)
  {
    put_all(round);
    return redistribute(decomposition_, bodies_);
  }

  /// As in a step: by less than a cell, with the halo's messages.
  Redistributed drift_to(int round)
  {
    put_all(round);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      EXPECT_FALSE(migration_.collect(bodies_[b], b).has_value()) << "nobody went too far";
    migration_.send();
    halo_.begin(NodeSum::mass_momentum, grid_, migration_.notes());
    halo_.end(grid_);
    const auto outcome = migration_.finish(bodies_, halo_.notes());
    Redistributed result{outcome.sent, {}};
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      result.arrived.push_back(bodies_[b].particles.size() - outcome.stayed[b]);
    return result;
  }

  /// The same particles under another map of owners.
  Redistributed repartition(const Ownership<Dim>& ownership)
  {
    decomposition_ = Decomposition<Dim>(MPI_COMM_WORLD, ownership);
    return redistribute(decomposition_, bodies_);
  }

  /// What this rank must hold after `round`, without asking any other rank.
  void expect_home(int round)
  {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const ParticleStore& particles = bodies_[b].particles;
      std::vector<GlobalIndex> expected;
      for (GlobalIndex id = first_ids_[b]; id < first_ids_[b] + counts_[b]; ++id)
        if (owner(id, round) == rank()) expected.push_back(id);
      std::vector<GlobalIndex> held(particles.ids().begin(), particles.ids().end());
      std::ranges::sort(held);
      EXPECT_EQ(held, expected) << "body " << b << " on rank " << rank() << " in round " << round;
      expect_all_fields(particles, round);
    }
  }

  /// Arrivals stand at the end, in the order of the ranks that they came from.
  void expect_arrivals_at_the_end(const Redistributed& outcome, int round)
  {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto ids = bodies_[b].particles.ids();
      const std::size_t stayed = ids.size() - outcome.arrived[b];
      int last_source = -1;
      for (std::size_t p = 0; p < ids.size(); ++p) {
        const int source = owner(ids[p], round - 1);
        EXPECT_EQ(source != rank(), p >= stayed) << "particle " << ids[p];
        if (p < stayed) continue;
        EXPECT_GE(source, last_source) << "particle " << ids[p];
        last_source = source;
      }
    }
  }

  /// Numbers, ids and masses over all ranks. Collective.
  void expect_nothing_lost()
  {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const ParticleStore& particles = bodies_[b].particles;
      std::array<GlobalIndex, 2> sums{particles.size(), 0};
      for (const GlobalIndex id : particles.ids()) sums[1] += id;
      sum_over_ranks(MPI_COMM_WORLD, sums);
      EXPECT_EQ(sums[0], counts_[b]);
      EXPECT_EQ(sums[1], counts_[b] * first_ids_[b] + counts_[b] * (counts_[b] - 1) / 2);

      // With the padding lanes, which must weigh nothing.
      const int mass = particles.motion().find("mass");
      double total = 0, expected = 0;
      for (LocalIndex block = 0; block < particles.blocks(); ++block)
        for (int lane = 0; lane < lane_count; ++lane)
          total += particles.motion().block(block)[mass * lane_count + lane];
      for (GlobalIndex id = first_ids_[b]; id < first_ids_[b] + counts_[b]; ++id)
        expected += signature(id, mass);
      sum_over_ranks(MPI_COMM_WORLD, std::span(&total, 1));
      EXPECT_NEAR(total, expected, 1e-12 * expected);
    }
  }

  int owner(GlobalIndex id, int round) const
  {
    return decomposition_.owner_of_cell(decomposition_.geometry().cell_of(path_(id, round)));
  }
  GlobalIndex migration_messages() const { return migration_.messages(); }
  std::vector<Body<Dim>>& bodies() { return bodies_; }

 private:
  static constexpr int support = 3;

  void put_all(int round)
  {
    for (Body<Dim>& body : bodies_)
      for (LocalIndex p = 0; p < body.particles.size(); ++p) put(body, p, round);
  }
  void put(Body<Dim>& body, LocalIndex p, int round)
  {
    const Vec<Dim> place = path_(body.particles.ids()[p], round);
    for (int d = 0; d < Dim; ++d) body.particles.motion()(d, p) = place[d];
  }

  static void expect_all_fields(const ParticleStore& particles, int round)
  {
    int wrong = 0;
    for (LocalIndex p = 0; p < particles.size(); ++p) {
      const GlobalIndex id = particles.ids()[p];
      for (int c = Dim; c < particles.motion().width(); ++c)
        wrong += particles.motion()(c, p) != signature(id, c);
      for (int c = 0; c < particles.state().width(); ++c)
        wrong += particles.state()(c, p) != signature(id, 100 + c);
    }
    EXPECT_EQ(wrong, 0) << "values on rank " << rank() << " in round " << round;
  }

  Decomposition<Dim> decomposition_;
  Halo<Dim> halo_;
  Migration<Dim> migration_;
  NodeGrid<Dim> grid_;
  Path<Dim> path_;
  std::vector<Body<Dim>> bodies_;
  std::vector<GlobalIndex> counts_, first_ids_;
};

IndexVec<2> two_rows()
{
  return ranks() % 2 == 0 ? IndexVec<2>(ranks() / 2, 2) : IndexVec<2>(ranks(), 1);
}

/// All columns that exist: affine field, re-mapping, plastic state.
void add_plastic_body(Cloud<2>& cloud, GlobalIndex first_id, int particles)
{
  const auto law = make_hencky(PlaneAssumption::strain, {1e9, 0.3}, 1000, YieldConstants{1e6});
  cloud.add_body(first_id, particles, MotionColumns<2, Apic>::columns(true), law->state_columns());
}

void add_elastic_body(Cloud<2>& cloud, GlobalIndex first_id, int particles)
{
  const auto law = make_hencky(PlaneAssumption::stress, {1e9, 0.3}, 1000, {});
  cloud.add_body(first_id, particles, MotionColumns<2, Flip>::columns(false), law->state_columns());
}

TEST(Redistribution, ParticlesDriftingOverCornersArriveOnceWithAllTheirFields)
{
  const IndexVec<2> cells(17, 14);
  Cloud<2> cloud(cells, two_rows(), diagonal_drift<2>(cells));
  add_plastic_body(cloud, 0, 211);
  for (int round = 1; round <= 40; ++round) {
    const auto outcome = cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_arrivals_at_the_end(outcome, round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, ParticlesCrossTwoNodesWidePartsAndSkipRanks)
{
  const IndexVec<2> cells(2 * ranks() - 1, 9);
  Cloud<2> cloud(cells, {ranks(), 1}, random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 97);
  for (int round = 1; round <= 30; ++round) {
    cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, TwoBodiesWithDifferentColumnsKeepApartOverManyFarJumps)
{
  const IndexVec<2> cells(25, 21);
  Cloud<2> cloud(cells, two_rows(), random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 150);
  add_elastic_body(cloud, GlobalIndex{1} << 40, 83);
  for (int round = 1; round <= 60; ++round) {
    const auto outcome = cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_arrivals_at_the_end(outcome, round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, ParticlesInSpaceArriveWithAllTheirFields)
{
  const IndexVec<3> cells(9, 8, 7);
  Cloud<3> cloud(cells, {0, 0, 0}, random_jumps<3>(cells));
  cloud.add_body(5, 130, MotionColumns<3, Tpic>::columns(true),
                 {{"initial_volume", 1, "m3"}, {"stress", 6, "Pa"}, {"plastic_strain", 1, "1"}});
  for (int round = 1; round <= 25; ++round) {
    cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, RanksWithoutAnyParticleAreSkipped)
{
  const IndexVec<2> cells(20, 20);
  Cloud<2> cloud(cells, two_rows(), corner_to_corner(cells));
  add_elastic_body(cloud, 0, 1);
  add_plastic_body(cloud, 1000, 24);
  for (int round = 1; round <= 20; ++round) {
    cloud.move_to(round);
    cloud.expect_home(round);
    cloud.expect_nothing_lost();
    if (rank() != 0 && rank() != ranks() - 1) {
      EXPECT_EQ(cloud.bodies()[1].particles.size(), 0);
    }
  }
}

TEST(Redistribution, BodyThatLeavesARankAltogetherLeavesNothingBehind)
{
  const IndexVec<2> cells(20, 20);
  Cloud<2> cloud(cells, two_rows(), [&](GlobalIndex id, int round) -> Vec<2> {
    const double place = round % 2 == 0 ? 0.3 : 19.3;
    return Vec<2>(place, place + 0.01 * double(id % 20));
  });
  add_plastic_body(cloud, 0, 33);
  for (int round = 1; round <= 6; ++round) {
    const auto outcome = cloud.move_to(round);
    cloud.expect_home(round);
    GlobalIndex sent = outcome.sent;
    sum_over_ranks(MPI_COMM_WORLD, std::span(&sent, 1));
    EXPECT_EQ(sent, ranks() == 1 ? 0 : 33);
    cloud.expect_nothing_lost();
  }
}

TEST(Redistribution, ParticlesOutsideTheGridStayWithTheNearestRank)
{
  const IndexVec<2> cells(12, 12);
  Cloud<2> cloud(cells, two_rows(), [](GlobalIndex id, int) -> Vec<2> {
    return id == 0 ? Vec<2>(-4, -2) : Vec<2>(15, 13);
  });
  add_plastic_body(cloud, 0, 2);
  cloud.move_to(1);
  cloud.expect_home(1);
  cloud.expect_nothing_lost();
}

/// Over all ranks. Collective.
GlobalIndex sum_of(GlobalIndex value)
{
  sum_over_ranks(MPI_COMM_WORLD, std::span(&value, 1));
  return value;
}

template <int Dim>
void expect_steps_to_deliver(Cloud<Dim>& cloud, int rounds)
{
  GlobalIndex sent = 0;
  for (int round = 1; round <= rounds; ++round) {
    const auto outcome = cloud.drift_to(round);
    sent += outcome.sent;
    cloud.expect_home(round);
    cloud.expect_arrivals_at_the_end(outcome, round);
    cloud.expect_nothing_lost();
  }
  EXPECT_EQ(sum_of(sent) > 0, ranks() > 1);
}

TEST(MigrationInAStep, ParticlesDriftingOverCornersArriveOnceWithAllTheirFields)
{
  const IndexVec<2> cells(17, 14);
  Cloud<2> cloud(cells, two_rows(), bouncing<2>(cells));
  add_plastic_body(cloud, 0, 211);
  add_elastic_body(cloud, GlobalIndex{1} << 40, 83);
  expect_steps_to_deliver(cloud, 40);
}

TEST(MigrationInAStep, ParticlesCrossTheBordersOfPartsOfAnyShape)
{
  const IndexVec<2> cells(17, 14);
  const GridGeometry<2> grid = Cloud<2>::grid_of(cells);
  for (const LocalIndex edge : {1, 2, 5}) {
    Cloud<2> cloud({MPI_COMM_WORLD, scattered_blocks(grid, edge, ranks(), 11)}, bouncing<2>(cells));
    add_plastic_body(cloud, 0, 130);
    expect_steps_to_deliver(cloud, 20);
  }
  Cloud<2> cloud({MPI_COMM_WORLD, metis_blocks(grid, ranks())}, bouncing<2>(cells));
  add_plastic_body(cloud, 0, 130);
  expect_steps_to_deliver(cloud, 40);
}

TEST(MigrationInAStep, ParticlesCrossTheBordersOfBlocksInSpace)
{
  const IndexVec<3> cells(9, 8, 7);
  Cloud<3> cloud({MPI_COMM_WORLD, metis_blocks(Cloud<3>::grid_of(cells), ranks())},
                 bouncing<3>(cells));
  cloud.add_body(5, 130, MotionColumns<3, Tpic>::columns(true),
                 {{"initial_volume", 1, "m3"}, {"stress", 6, "Pa"}});
  expect_steps_to_deliver(cloud, 25);
}

TEST(MigrationInAStep, NobodySendsAMessageWhileNobodyLeaves)
{
  const IndexVec<2> cells(16, 16);
  Cloud<2> cloud(cells, two_rows(), [](GlobalIndex id, int round) -> Vec<2> {
    return Vec<2>(double(id % 16) + 0.1 * (round % 9 + 1), double(id / 16 % 16) + 0.5);
  });
  add_plastic_body(cloud, 0, 256);
  for (int round = 1; round <= 20; ++round) cloud.drift_to(round);
  EXPECT_EQ(cloud.migration_messages(), 0);
  cloud.expect_home(20);
}

TEST(MigrationInAStep, ParticleBeyondTheNextCellsIsNamed)
{
  if (ranks() == 1) GTEST_SKIP() << "one rank owns every cell";
  const IndexVec<2> cells(6 * ranks(), 6);
  const Decomposition<2> decomposition(MPI_COMM_WORLD, Cloud<2>::grid_of(cells), {ranks(), 1}, {},
                                       {});
  const Halo<2> halo(decomposition, 3);
  Migration<2> migration(decomposition, 3, halo.neighbours());
  Body<2> body{"cloud", 0, 1.0, nullptr,
               ParticleStore(MotionColumns<2, Flip>::columns(false), {}, {"mass"})};
  const IndexBox<2> owned = decomposition.owned(decomposition.rank());
  const bool last = decomposition.rank() == ranks() - 1;
  const double far = last ? owned.lower[0] - 1.5 : owned.upper[0] + 1.5;
  for (const double x : {owned.lower[0] + 1.0, far, owned.lower[0] + 2.0}) {
    const LocalIndex p = body.particles.add(body.particles.size());
    body.particles.motion()(0, p) = x;
    body.particles.motion()(1, p) = 3;
  }
  body.particles.seal();
  const auto strayed = migration.collect(body, 0);
  ASSERT_TRUE(strayed.has_value());
  EXPECT_EQ(*strayed, 1);
}

TEST(Redistribution, NothingIsLostWhileTheMapOfOwnersChangesAgainAndAgain)
{
  const IndexVec<2> cells(21, 18);
  const GridGeometry<2> grid = Cloud<2>::grid_of(cells);
  Cloud<2> cloud(cells, {0, 0}, random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 150);
  add_elastic_body(cloud, 7000, 90);
  for (int round = 1; round <= 15; ++round) {
    cloud.repartition(round % 3 == 0   ? metis_blocks(grid, ranks())
                      : round % 3 == 1 ? scattered_blocks(grid, 3, ranks(), unsigned(round))
                                       : weighted_cuts<2>(grid, ranks(), two_rows(), {}, {}));
    cloud.expect_home(round - 1);
    cloud.expect_nothing_lost();
    cloud.move_to(round);
    cloud.expect_home(round);
  }
}

// Nothing but the exchange itself keeps the ranks together here: a fast rank's next exchange meets
// a slow one's last.
TEST(Redistribution, ExchangesBackToBackDoNotMixWhenRanksAreDelayed)
{
  const IndexVec<2> cells(22, 19);
  Cloud<2> cloud(cells, two_rows(), random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 120);
  add_elastic_body(cloud, 5000, 70);
  std::mt19937 draw(unsigned(rank() + 1));
  for (int round = 1; round <= 60; ++round) {
    const auto delay = std::chrono::microseconds(draw() % 4 == 0 ? 1500 * (draw() % 3) : 0);
    std::this_thread::sleep_for(delay);
    cloud.move_to(round);
    std::this_thread::sleep_for(std::chrono::microseconds(draw() % 2 == 0 ? 300 * rank() : 0));
    cloud.expect_home(round);
  }
  cloud.expect_nothing_lost();
}

}  // namespace
}  // namespace mpm
