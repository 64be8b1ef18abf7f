// Contact by overlaps on several ranks: forces are the gradient of one energy, whoever has the
// cells, also across a periodic side.
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "contact_cells.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

constexpr int cells = 60;

template <int Dim>
struct Scene {
  std::vector<Vec<Dim>> corners;  ///< m, of all cells
  IndexVec<Dim> period = IndexVec<Dim>::Zero();
  bool outlined = false;  ///< every third cell is seen elsewhere than its nodes are
};

/// Cells thrown into a box in which they cannot but lie upon each other. No two share a face, but
/// many are near in the lattice.
template <int Dim>
Scene<Dim> thrown(unsigned seed, const IndexVec<Dim>& period, double crooked)
{
  Scene<Dim> scene{{}, period};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, Dim == 2 ? 7e-3 : 3.4e-3),
      around(-crooked, crooked);
  for (int c = 0; c < cells; ++c) {
    const Vec<Dim> middle = Vec<Dim>::NullaryExpr([&] { return place(random); });
    for (int k = 0; k < corners<Dim>; ++k)
      scene.corners.push_back(middle + (corner_at<Dim>(k) + Vec<Dim>::NullaryExpr([&] {
                                          return around(random);
                                        })).cwiseProduct(size<Dim>()));
  }
  return scene;
}

/// Energy, overlap and forces of all ranks' cells, and what friction of 0.3 does to them.
struct Found {
  double energy = 0, overlap = 0, deepest = 0;
  GlobalIndex pairs = 0;
  std::vector<double> force, friction;
};

/// Of a cell at rest on the lattice, with one corner moved outwards, two inwards.
CellOutline uneven_outline()
{
  std::array<Vec<2>, 4> rest, ways;
  for (int k = 0; k < 4; ++k) rest[std::size_t(k)] = corner_at<2>(k).cwiseProduct(size<2>());
  ways = {Vec<2>(-0.3e-3, -0.2e-3), Vec<2>(-0.2e-3, 0.1e-3), Vec<2>::Zero(), Vec<2>(0, -0.15e-3)};
  return *CellOutline::at(rest, ways);
}

/// Where corners stood when pairs were found. Their nodes had so much room then, over the way that
/// they have gone since.
template <int Dim>
struct Start {
  std::vector<Vec<Dim>> corners;
  double room;
};

/// Shares the cells out among the ranks in turn, or keeps them all. Collective.
template <int Dim>
Found contact_of(MPI_Comm comm, const Scene<Dim>& scene, const Start<Dim>* start = nullptr)
{
  const int me = rank_of(comm), ranks = ranks_of(comm);
  typename OverlapContact<Dim>::Cells own;
  std::vector<Vec<Dim>> places, ways;
  std::vector<int> numbers;
  for (int c = me; c < cells; c += ranks) {
    const IndexVec<3> location(2 * (c % 8), 2 * (c / 8), 0);
    own.cells.push_back(cell_at<Dim>(int(numbers.size()), location.head<Dim>()));
    if (scene.outlined && c % 3 == 0) {
      own.cells.back().outline = LocalIndex(own.outlines.size());
      own.outlines.push_back(uneven_outline());
    }
    numbers.push_back(c);
    for (int k = 0; k < corners<Dim>; ++k) {
      const auto corner = std::size_t(corners<Dim> * c + k);
      const Vec<Dim>& then = start ? start->corners[corner] : scene.corners[corner];
      places.push_back(then);
      ways.push_back(scene.corners[corner] - then);
    }
  }
  Mesh<Dim> mesh(places);
  BodyPairs bodies(1);
  bodies.add(0, 0, 0.3);
  OverlapContact<Dim> contact(comm, own, 2, bodies, size<Dim>(), scene.period);
  if constexpr (Dim == 2) {
    const double uneven = uneven_outline().reach();
    EXPECT_GT(uneven, 1.1);
    EXPECT_EQ(contact.reach(), scene.outlined ? uneven : 1) << "on every rank";
  }
  std::vector<double> room = rooms(mesh.nodes);
  if (start)
    for (std::size_t n = 0; n < room.size(); ++n)
      room[n] = start->room * contact.reach() * ways[n].norm();
  contact.find_pairs(mesh.nodes, room);
  if (start) {
    for (std::size_t n = 0; n < ways.size(); ++n)
      for (int d = 0; d < Dim; ++d) mesh.fields.updated_of(LocalIndex(n))[d] = ways[n][d];
    mesh.nodes.move(mesh.fields, 1);
    const std::vector<double> ahead(room.size(), 0.1e-3);
    const double farthest = largest_over_ranks(
        comm, ways.empty() ? 0 : std::ranges::max(ways, {}, &Vec<Dim>::squaredNorm).norm());
    const double beyond = contact.beyond_rooms(mesh.nodes, ahead) / contact.reach();
    EXPECT_NEAR(largest_over_ranks(comm, beyond), (1 - start->room) * farthest + 0.1e-3, 1e-12);
  }
  contact.measure(mesh.nodes);
  contact.add_forces(mesh.fields);
  Found found;
  const auto values = scene.corners.size() * Dim;
  std::vector<double> friction(places.size() * Dim, 0.0);
  std::mt19937 random(3);
  std::vector<double> motion(values);
  std::uniform_real_distribution<double> around(-1, 1);
  for (double& v : motion) v = around(random);
  const auto place_of = [&](std::size_t n, int d) {
    const auto in_cell = n % std::size_t(corners<Dim>);
    return (std::size_t(corners<Dim> * numbers[n / std::size_t(corners<Dim>)]) + in_cell) * Dim +
           std::size_t(d);
  };
  for (std::size_t n = 0; n < places.size(); ++n) {
    mesh.fields.mass_of(LocalIndex(n)) = 1;
    for (int d = 0; d < Dim; ++d) mesh.fields.updated_of(LocalIndex(n))[d] = motion[place_of(n, d)];
  }
  contact.add_friction(mesh.fields, 1e-9, friction);
  std::vector<double> sums{contact.energy(), contact.overlapped_area()};
  found.force.assign(values, 0.0);
  found.friction.assign(values, 0.0);
  for (std::size_t n = 0; n < places.size(); ++n)
    for (int d = 0; d < Dim; ++d) {
      found.force[place_of(n, d)] = mesh.fields.force_of(LocalIndex(n))[d];
      found.friction[place_of(n, d)] = friction[n * Dim + std::size_t(d)];
    }
  sum_over_ranks(comm, sums);
  sum_over_ranks(comm, found.force);
  sum_over_ranks(comm, found.friction);
  found.energy = sums[0];
  found.overlap = sums[1];
  found.deepest = largest_over_ranks(comm, contact.deepest_overlap());
  found.pairs = contact.touching();
  sum_over_ranks(comm, std::span(&found.pairs, 1));
  return found;
}

void expect_alike(const Found& together, const Found& alone)
{
  EXPECT_EQ(together.pairs, alone.pairs);
  EXPECT_NEAR(together.energy / alone.energy, 1, 1e-12);
  EXPECT_NEAR(together.overlap / alone.overlap, 1, 1e-12);
  EXPECT_NEAR(together.deepest / alone.deepest, 1, 1e-12);
  const double largest = std::ranges::max(alone.force);
  for (std::size_t k = 0; k < alone.force.size(); ++k) {
    ASSERT_NEAR(together.force[k] / largest, alone.force[k] / largest, 1e-11) << k;
    ASSERT_NEAR(together.friction[k] / largest, alone.friction[k] / largest, 1e-11) << k;
  }
  EXPECT_GT(std::ranges::max(alone.friction), 1e-3 * largest);
}

/// Forces are minus the slopes of the energy, and sum to zero.
template <int Dim>
void expect_gradient(const Scene<Dim>& scene)
{
  const Found found = contact_of(MPI_COMM_WORLD, scene);
  const double largest = std::ranges::max(found.force);
  constexpr double step = 1e-9;
  for (std::size_t k = 0; k < found.force.size(); k += 5) {
    Scene<Dim> above = scene, below = scene;
    above.corners[k / Dim][Eigen::Index(k % Dim)] += step;
    below.corners[k / Dim][Eigen::Index(k % Dim)] -= step;
    const double slope =
        (contact_of(MPI_COMM_WORLD, above).energy - contact_of(MPI_COMM_WORLD, below).energy) /
        (2 * step);
    ASSERT_NEAR(found.force[k] / largest, -slope / largest, 1e-5) << k;
  }
  for (const std::vector<double>& values : {found.force, found.friction}) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < values.size(); ++k) sum[Eigen::Index(k % Dim)] += values[k];
    EXPECT_LT(sum.norm(), 1e-12 * largest);
  }
}

template <int Dimensions, bool Periodic>
struct Sides {
  static constexpr int dim = Dimensions;
  static IndexVec<Dimensions> period()
  {
    const IndexVec<Dimensions> box =
        IndexVec<3>(400, Dimensions == 2 ? 9 : 6, 5).head<Dimensions>();
    return Periodic ? box : IndexVec<Dimensions>(IndexVec<Dimensions>::Zero());
  }
};
struct SidesName {
  template <class Case>
  static std::string GetName(int)
  {
    return std::string(Case::dim == 2 ? "Plane" : "Space") +
           (Case::period()[0] > 0 ? "Periodic" : "Open");
  }
};

template <class Case>
class OverlapContacts : public ::testing::Test {
};
using Cases = ::testing::Types<Sides<2, false>, Sides<2, true>, Sides<3, false>, Sides<3, true>>;
TYPED_TEST_SUITE(OverlapContacts, Cases, SidesName);

TYPED_TEST(OverlapContacts, AreTheSameOnAnyRanks)
{
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto scene = thrown<TypeParam::dim>(seed, TypeParam::period(), 0.1);
    const Found together = contact_of(MPI_COMM_WORLD, scene);
    const Found alone = contact_of(MPI_COMM_SELF, scene);
    EXPECT_GT(alone.pairs, 100);
    expect_alike(together, alone);
  }
}

TYPED_TEST(OverlapContacts, HaveForcesThatAreTheGradientOfOneEnergyAndSumToZero)
{
  // Few, some and many of the cells have a reflex corner in the plane.
  for (const double crooked : {0.1, 0.3, 0.4})
    expect_gradient(thrown<TypeParam::dim>(7, TypeParam::period(), crooked));
}

TYPED_TEST(OverlapContacts, AreFoundBeforeNodesHaveGoneAsFarAsTheirRooms)
{
  constexpr int dim = TypeParam::dim;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto scene = thrown<dim>(seed, TypeParam::period(), 0.1);
    std::mt19937 random(seed + 100);
    std::uniform_real_distribution<double> around(-1, 1);
    Start<dim> start{scene.corners, 1};
    for (int c = 0; c < cells; ++c) {
      const double far = c % 5 == 0 ? 3e-3 : 0.2e-3;
      const Vec<dim> way = far * Vec<dim>::NullaryExpr([&] { return around(random); });
      for (int k = 0; k < corners<dim>; ++k)
        start.corners[std::size_t(corners<dim> * c + k)] += way;
    }
    const Found alone = contact_of(MPI_COMM_SELF, scene);
    expect_alike(contact_of(MPI_COMM_WORLD, scene, &start), alone);
    start.room = 0.1;
    EXPECT_LT(contact_of(MPI_COMM_WORLD, scene, &start).pairs, alone.pairs);
  }
}

/// As if something had slid along a periodic side.
template <int Dim>
void expect_that_whole_periods_are_nothing()
{
  const IndexVec<Dim> period = Sides<Dim, true>::period();
  const Scene<Dim> scene = thrown<Dim>(3, period, 0.1);
  Scene<Dim> slid = scene;
  for (int c = 0; c < cells; ++c)
    for (int k = 0; k < corners<Dim>; ++k)
      slid.corners[std::size_t(corners<Dim> * c + k)][1] +=
          (c % 5 - 1) * period[1] * size<Dim>()[1];
  const Found alone = contact_of(MPI_COMM_SELF, scene);
  expect_alike(contact_of(MPI_COMM_SELF, slid), alone);
  expect_alike(contact_of(MPI_COMM_WORLD, slid), alone);
}

TEST(OverlapContact, IsTheSameWithAnyNumberOfPeriodsBetweenInThePlane)
{
  expect_that_whole_periods_are_nothing<2>();
}

TEST(OverlapContact, IsTheSameWithAnyNumberOfPeriodsBetweenInSpace)
{
  expect_that_whole_periods_are_nothing<3>();
}

/// Two cells across a node, on which a third body is open for one of them alone.
TEST(OverlapContact, OfNeighboursIsThereWhereEitherSeesTheirCornerOpen)
{
  for (const int closed : {0, 1}) {
    const int me = rank_of(MPI_COMM_WORLD), ranks = ranks_of(MPI_COMM_WORLD);
    OverlapContact<2>::Cells own;
    std::vector<Vec<2>> places;
    for (int c = 0; c < 2; ++c) {
      if (c % ranks != me) continue;
      own.cells.push_back(cell_at<2>(int(own.cells.size()), IndexVec<2>(c, c)));
      constexpr unsigned outer_layer = 1u << 4;
      if (c == closed) own.cells.back().open = OpenCorners<2>(outer_layer);
      for (int k = 0; k < corners<2>; ++k)
        places.push_back((corner_at<2>(k) + Vec<2>::Constant(0.9 * c)).cwiseProduct(size<2>()));
    }
    Mesh<2> mesh(places);
    OverlapContact<2> contact(MPI_COMM_WORLD, own, 2, BodyPairs(1), size<2>(), {0, 0});
    contact.find_pairs(mesh.nodes, rooms(mesh.nodes));
    contact.measure(mesh.nodes);
    contact.add_forces(mesh.fields);
    std::vector<double> sums(4, 0.0);
    for (LocalIndex n = 0; n < mesh.nodes.size(); ++n)
      for (int d = 0; d < 2; ++d) {
        sums[std::size_t(d)] += mesh.fields.force_of(n)[d];
        sums[std::size_t(2 + d)] += std::abs(mesh.fields.force_of(n)[d]);
      }
    sum_over_ranks(MPI_COMM_WORLD, sums);
    for (const std::size_t d : {0, 1}) {
      EXPECT_GT(sums[2 + d], 0) << closed;
      EXPECT_LT(std::abs(sums[d]), 1e-12 * sums[2 + d]) << closed;
    }
  }
}

TEST(OverlapContact, PushesTheNodesOfCellsThatAreSeenElsewhere)
{
  Scene<2> scene = thrown<2>(7, IndexVec<2>::Zero(), 0.1);
  const Found before = contact_of(MPI_COMM_SELF, scene);
  scene.outlined = true;
  const Found alone = contact_of(MPI_COMM_SELF, scene),
              together = contact_of(MPI_COMM_WORLD, scene);
  EXPECT_GT(std::abs(alone.energy / before.energy - 1), 0.01);
  expect_alike(together, alone);
  expect_gradient(scene);
}

}  // namespace
}  // namespace mpm
