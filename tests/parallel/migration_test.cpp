#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/migration.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/transfer/scheme.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <thread>

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
      : decomposition_(MPI_COMM_WORLD,
                       {Vec<Dim>::Zero(), Vec<Dim>::Ones(), (cells.array() + 1).matrix()}, wish, {},
                       {}),
        migration_(decomposition_),
        path_(std::move(path))
  {
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

  typename Migration<Dim>::Outcome move_to(int round, bool failed = false)
  {
    std::vector<std::vector<LocalIndex>> blocks(bodies_.size());
    std::vector<typename Migration<Dim>::Leavers> leavers;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      ParticleStore& particles = bodies_[b].particles;
      for (LocalIndex p = 0; p < particles.size(); ++p) {
        put(bodies_[b], p, round);
        const bool leaves = owner(particles.ids()[p], round) != rank();
        if (leaves && (blocks[b].empty() || blocks[b].back() != p / lane_count))
          blocks[b].push_back(p / lane_count);
      }
      leavers.push_back({&bodies_[b], blocks[b]});
    }
    return migration_.exchange(leavers, failed);
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
  void expect_arrivals_at_the_end(const typename Migration<Dim>::Outcome& outcome, int round)
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
  const Decomposition<Dim>& decomposition() const { return decomposition_; }
  std::vector<Body<Dim>>& bodies() { return bodies_; }

 private:
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
  Migration<Dim> migration_;
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

TEST(Migration, ParticlesDriftingOverCornersArriveOnceWithAllTheirFields)
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

TEST(Migration, ParticlesCrossTwoNodesWidePartsAndSkipRanks)
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

TEST(Migration, TwoBodiesWithDifferentColumnsKeepApartOverManyFarJumps)
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

TEST(Migration, ParticlesInSpaceArriveWithAllTheirFields)
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

TEST(Migration, RanksWithoutAnyParticleAreSkipped)
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

TEST(Migration, BodyThatLeavesARankAltogetherLeavesNothingBehind)
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

TEST(Migration, ParticlesOutsideTheGridStayWithTheNearestRank)
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

TEST(Migration, FailureOfAnyRankReachesAllOnceAndIsForgotten)
{
  const IndexVec<2> cells(16, 16);
  Cloud<2> cloud(cells, two_rows(), random_jumps<2>(cells));
  add_plastic_body(cloud, 0, 60);
  int round = 0;
  for (int culprit = 0; culprit < ranks(); ++culprit) {
    EXPECT_TRUE(cloud.move_to(++round, rank() == culprit).failed) << "culprit " << culprit;
    EXPECT_FALSE(cloud.move_to(++round).failed) << "after culprit " << culprit;
    cloud.expect_home(round);
  }
  EXPECT_TRUE(cloud.move_to(++round, true).failed);
  cloud.expect_nothing_lost();
}

// Nothing but the exchange itself keeps the ranks together here: a fast rank's next exchange meets
// a slow one's last.
TEST(Migration, ExchangesBackToBackDoNotMixWhenRanksAreDelayed)
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
