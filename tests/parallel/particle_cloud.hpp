#pragma once
/// Particles on prescribed paths, checked after each exchange between ranks.

#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/migration.hpp>
#include <mpm/parallel/redistribution.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/transfer/apic.hpp>
#include <mpm/transfer/flip.hpp>
#include <mpm/transfer/tpic.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "node_grid.hpp"
#include <gmock/gmock.h>

namespace mpm::particle_clouds {

inline int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}
inline int rank()
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
inline Path<2> corner_to_corner(const IndexVec<2>& cells)
{
  return [cells](GlobalIndex id, int round) -> Vec<2> {
    const double inside = 0.1 + 0.8 * double(id % 10) / 10;
    if ((id + round) % 2 == 0) return Vec<2>(inside, inside);
    return Vec<2>(cells[0] - inside, cells[1] - inside);
  };
}

/// Value of a column that names its particle and itself, without rounding.
inline double signature(GlobalIndex id, int column)
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
    const NodeColumn mass = grid_.fields.mass_column();
    halo_.begin(std::span(&mass, 1), migration_.notes());
    halo_.end();
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
  Halo halo_;
  Migration<Dim> migration_;
  NodeGrid<Dim> grid_;
  Path<Dim> path_;
  std::vector<Body<Dim>> bodies_;
  std::vector<GlobalIndex> counts_, first_ids_;
};

inline IndexVec<2> two_rows()
{
  return ranks() % 2 == 0 ? IndexVec<2>(ranks() / 2, 2) : IndexVec<2>(ranks(), 1);
}

/// All columns that exist: affine field, re-mapping, plastic state.
inline void add_plastic_body(Cloud<2>& cloud, GlobalIndex first_id, int particles)
{
  const auto law = make_hencky(PlaneAssumption::strain, {1e9, 0.3}, 1000, YieldConstants{1e6});
  cloud.add_body(first_id, particles, MotionColumns<2, Apic>::columns(true), law->state_columns());
}

inline void add_elastic_body(Cloud<2>& cloud, GlobalIndex first_id, int particles)
{
  const auto law = make_hencky(PlaneAssumption::stress, {1e9, 0.3}, 1000, {});
  cloud.add_body(first_id, particles, MotionColumns<2, Flip>::columns(false), law->state_columns());
}

}  // namespace mpm::particle_clouds
