// Contact by overlapped areas on several ranks: forces are the gradient of one energy, whoever has
// the cells, also across a periodic side.
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<2> size(1e-3, 0.8e-3);
constexpr double stiffness = 4e9;
constexpr int cells = 60;
constexpr double skin = 0.3e-3;

struct Scene {
  Eigen::Matrix2Xd corners{2, 4 * cells};  ///< m, counter-clockwise
  IndexVec<2> period{0, 0};
};

/// Cells thrown into a box in which they cannot but lie upon each other. No two share a side, but
/// many are near in the lattice.
Scene thrown(unsigned seed, const IndexVec<2>& period, double crooked)
{
  Scene scene{.period = period};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 7e-3), around(-crooked, crooked);
  constexpr double side[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  for (int c = 0; c < cells; ++c) {
    const Vec<2> middle(place(random), place(random));
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        scene.corners(d, 4 * c + k) = middle[d] + size[d] * (side[k][d] + around(random));
  }
  return scene;
}

/// Energy, area and forces of all ranks' cells, each of which has its own four nodes.
struct Found {
  double energy = 0, area = 0;
  GlobalIndex pairs = 0;
  std::vector<double> force = std::vector<double>(8 * cells, 0.0);
};

/// Shares the cells out among the ranks in turn, or keeps them all. Collective.
Found contact_of(MPI_Comm comm, const Scene& scene)
{
  const int me = rank_of(comm), ranks = ranks_of(comm);
  std::vector<OverlapContact<2>::Cell> own;
  std::vector<IndexVec<2>> nodes;
  std::vector<int> numbers;
  for (int c = me; c < cells; c += ranks) {
    const LocalIndex first = LocalIndex(nodes.size());
    for (int k = 0; k < 4; ++k) nodes.push_back({0, 0});
    own.push_back({{first, first + 1, first + 2, first + 3},
                   IndexVec<2>(2 * (c % 8), 2 * (c / 8)),
                   stiffness,
                   OpenCorners<2>::all(),
                   0,
                   c});
    numbers.push_back(c);
  }
  MeshNodes<2> mesh(nodes, std::vector<char>(nodes.size(), 1), size, IndexVec<2>::Zero());
  NodeFields<2> fields(mesh.size(), {.gradient = false}, 0);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int d = 0; d < 2; ++d)
      fields.updated_of(LocalIndex(n))[d] = scene.corners(d, 4 * numbers[n / 4] + int(n % 4));
  mesh.move(fields, 1);
  OverlapContact<2> contact(comm, own, 2, BodyPairs(1), size, scene.period);
  contact.find_pairs(mesh, skin);
  contact.measure(mesh);
  contact.add_forces(fields);
  Found found;
  std::vector<double> sums{contact.energy(), contact.overlapped_area()};
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int d = 0; d < 2; ++d)
      found.force[std::size_t(8 * numbers[n / 4]) + 2 * (n % 4) + std::size_t(d)] =
          fields.force_of(LocalIndex(n))[d];
  sum_over_ranks(comm, sums);
  sum_over_ranks(comm, found.force);
  found.energy = sums[0];
  found.area = sums[1];
  found.pairs = contact.touching();
  sum_over_ranks(comm, std::span(&found.pairs, 1));
  return found;
}

/// Forces are minus the slopes of the energy, and sum to zero.
void expect_gradient(const Scene& scene)
{
  const Found found = contact_of(MPI_COMM_WORLD, scene);
  const double largest = std::ranges::max(found.force);
  constexpr double step = 1e-9;
  for (int k = 0; k < 8 * cells; k += 5) {
    Scene above = scene, below = scene;
    above.corners(k % 2, k / 2) += step;
    below.corners(k % 2, k / 2) -= step;
    const double slope =
        (contact_of(MPI_COMM_WORLD, above).energy - contact_of(MPI_COMM_WORLD, below).energy) /
        (2 * step);
    ASSERT_NEAR(found.force[std::size_t(k)] / largest, -slope / largest, 1e-5) << k;
  }
  Vec<2> sum = Vec<2>::Zero();
  for (std::size_t k = 0; k < found.force.size(); ++k) sum[k % 2] += found.force[k];
  EXPECT_LT(sum.norm(), 1e-12 * largest);
}

class OverlapContacts : public ::testing::TestWithParam<bool> {
 protected:
  IndexVec<2> period() const { return GetParam() ? IndexVec<2>(400, 9) : IndexVec<2>(0, 0); }
};

TEST_P(OverlapContacts, AreTheSameOnAnyRanks)
{
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Scene scene = thrown(seed, period(), 0.1);
    const Found together = contact_of(MPI_COMM_WORLD, scene);
    const Found alone = contact_of(MPI_COMM_SELF, scene);
    EXPECT_GT(alone.pairs, 100);
    EXPECT_EQ(together.pairs, alone.pairs);
    EXPECT_NEAR(together.energy / alone.energy, 1, 1e-12);
    EXPECT_NEAR(together.area / alone.area, 1, 1e-12);
    const double largest = std::ranges::max(alone.force);
    for (std::size_t k = 0; k < alone.force.size(); ++k)
      ASSERT_NEAR(together.force[k] / largest, alone.force[k] / largest, 1e-11) << k;
  }
}

TEST_P(OverlapContacts, HaveForcesThatAreTheGradientOfOneEnergyAndSumToZero)
{
  // Few, some and many of the cells have a reflex corner.
  for (const double crooked : {0.1, 0.3, 0.4}) expect_gradient(thrown(7, period(), crooked));
}

INSTANTIATE_TEST_SUITE_P(Sides, OverlapContacts, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Periodic" : "Open"; });

/// Across a flush face the pressure is 2 kappa C times the depth over the size of a cell, however
/// the lattices of the two sides lie to each other.
TEST(OverlapContact, PressesAlikeHoweverTheLatticesLie)
{
  constexpr int across = 10;
  for (const auto& [depth, shift] : std::to_array<std::pair<double, double>>(
           {{0.001, 0.0}, {0.001, 0.5}, {0.03, 0.0}, {0.03, 0.1}, {0.03, 0.5}, {0.03, 0.7}})) {
    std::vector<OverlapContact<2>::Cell> surface;
    std::vector<Vec<2>> places;
    for (int row = 0; row < 2; ++row)
      for (int c = 0; c < across; ++c) {
        const LocalIndex first = LocalIndex(places.size());
        const Vec<2> lower((c + row * shift) * size[0], row * (1 - depth) * size[1]);
        for (const Vec<2>& corner : {Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(1, 1), Vec<2>(0, 1)})
          places.push_back(lower + corner.cwiseProduct(size));
        // Cells of a row are neighbours; the rows are not.
        surface.push_back({{first, first + 1, first + 2, first + 3},
                           IndexVec<2>(c, 5 * row),
                           stiffness,
                           OpenCorners<2>::all(),
                           0,
                           c});
      }
    MeshNodes<2> mesh(std::vector<IndexVec<2>>(places.size(), IndexVec<2>::Zero()),
                      std::vector<char>(places.size(), 1), size, IndexVec<2>::Zero());
    NodeFields<2> fields(mesh.size(), {.gradient = false}, 0);
    for (std::size_t n = 0; n < places.size(); ++n)
      for (int d = 0; d < 2; ++d) fields.updated_of(LocalIndex(n))[d] = places[n][d];
    mesh.move(fields, 1);
    OverlapContact<2> contact(MPI_COMM_SELF, surface, 2, BodyPairs(1), size, IndexVec<2>::Zero());
    contact.find_pairs(mesh, skin);
    contact.measure(mesh);
    contact.add_forces(fields);
    // A cell in the middle of the upper row.
    double pushed = 0, along = 0;
    for (int k = 0; k < 4; ++k) {
      pushed += fields.force_of(4 * (across + across / 2) + k)[1];
      along += fields.force_of(4 * (across + across / 2) + k)[0];
    }
    const OverlapShare one((1 - shift) * depth), other(shift * depth);
    const OverlapPotential potential(one.value + other.value);
    const double pressure = potential.pressure(one.value + other.value) *
                            ((1 - shift) * one.slope + shift * other.slope);
    EXPECT_NEAR(pushed / (2 * stiffness * size[0] * pressure), 1, 1e-9) << depth << " " << shift;
    // What slides on to the next cell feels no more than a ridge as steep as it is deep.
    EXPECT_LT(std::abs(along / pushed), depth) << shift;
    // A cell more at a face is half the onset less.
    const double beyond = depth - OverlapShare::onset;
    if (beyond > 0) {
      EXPECT_LE(pressure, OverlapPotential(depth).pressure(depth));
      EXPECT_GE(pressure, 0.95 * OverlapPotential(beyond).pressure(beyond));
    }
  }
}

}  // namespace
}  // namespace mpm
