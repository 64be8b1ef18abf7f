// Contact by overlaps on several ranks: forces are the gradient of one energy, whoever has the
// cells, also across a periodic side.
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

constexpr double stiffness = 4e9;
constexpr int cells = 60;
constexpr double skin = 0.3e-3;

template <int Dim>
Vec<Dim> size()
{
  return Vec<3>(1e-3, 0.8e-3, 1.1e-3).head<Dim>();
}

template <int Dim>
constexpr int corners = 1 << Dim;

/// Of a cell of the size 1, from its middle, in the order of CellOverlaps.
template <int Dim>
Vec<Dim> corner_at(int corner)
{
  Vec<Dim> at;
  for (int d = 0; d < Dim; ++d)
    at[d] = CellOverlaps<Dim>::order[std::size_t(corner)] >> d & 1 ? 0.5 : -0.5;
  return at;
}

template <int Dim>
struct Scene {
  std::vector<Vec<Dim>> corners;  ///< m, of all cells
  IndexVec<Dim> period = IndexVec<Dim>::Zero();
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

/// Nodes that stand at places, m, of cells that have their own ones each.
template <int Dim>
struct Mesh {
  explicit Mesh(const std::vector<Vec<Dim>>& places)
      : nodes(std::vector<IndexVec<Dim>>(places.size(), IndexVec<Dim>::Zero()),
              std::vector<char>(places.size(), 1), size<Dim>(), IndexVec<Dim>::Zero()),
        fields(nodes.size(), {.gradient = false}, 0)
  {
    for (std::size_t n = 0; n < places.size(); ++n)
      for (int d = 0; d < Dim; ++d) fields.updated_of(LocalIndex(n))[d] = places[n][d];
    nodes.move(fields, 1);
  }
  MeshNodes<Dim> nodes;
  NodeFields<Dim> fields;
};

template <int Dim>
typename OverlapContact<Dim>::Cell cell_at(int number, const IndexVec<Dim>& location)
{
  typename OverlapContact<Dim>::Cell cell{{}, location, stiffness, OpenCorners<Dim>::all(),
                                          0,  number};
  for (int k = 0; k < corners<Dim>; ++k)
    cell.nodes[std::size_t(k)] = LocalIndex(corners<Dim> * number + k);
  return cell;
}

/// Energy, overlap and forces of all ranks' cells, and what friction of 0.3 does to them.
struct Found {
  double energy = 0, overlap = 0;
  GlobalIndex pairs = 0;
  std::vector<double> force, friction;
};

/// Shares the cells out among the ranks in turn, or keeps them all. Collective.
template <int Dim>
Found contact_of(MPI_Comm comm, const Scene<Dim>& scene)
{
  const int me = rank_of(comm), ranks = ranks_of(comm);
  std::vector<typename OverlapContact<Dim>::Cell> own;
  std::vector<Vec<Dim>> places;
  std::vector<int> numbers;
  for (int c = me; c < cells; c += ranks) {
    const IndexVec<3> location(2 * (c % 8), 2 * (c / 8), 0);
    own.push_back(cell_at<Dim>(int(numbers.size()), location.head<Dim>()));
    numbers.push_back(c);
    for (int k = 0; k < corners<Dim>; ++k)
      places.push_back(scene.corners[std::size_t(corners<Dim> * c + k)]);
  }
  Mesh<Dim> mesh(places);
  BodyPairs bodies(1);
  bodies.add(0, 0, 0.3);
  OverlapContact<Dim> contact(comm, own, 2, bodies, size<Dim>(), scene.period);
  contact.find_pairs(mesh.nodes, skin);
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
  found.pairs = contact.touching();
  sum_over_ranks(comm, std::span(&found.pairs, 1));
  return found;
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
    EXPECT_EQ(together.pairs, alone.pairs);
    EXPECT_NEAR(together.energy / alone.energy, 1, 1e-12);
    EXPECT_NEAR(together.overlap / alone.overlap, 1, 1e-12);
    const double largest = std::ranges::max(alone.force);
    for (std::size_t k = 0; k < alone.force.size(); ++k) {
      ASSERT_NEAR(together.force[k] / largest, alone.force[k] / largest, 1e-11) << k;
      ASSERT_NEAR(together.friction[k] / largest, alone.friction[k] / largest, 1e-11) << k;
    }
    EXPECT_GT(std::ranges::max(alone.friction), 1e-3 * largest);
  }
}

TYPED_TEST(OverlapContacts, HaveForcesThatAreTheGradientOfOneEnergyAndSumToZero)
{
  // Few, some and many of the cells have a reflex corner in the plane.
  for (const double crooked : {0.1, 0.3, 0.4})
    expect_gradient(thrown<TypeParam::dim>(7, TypeParam::period(), crooked));
}

/// Two layers of cells that lie upon each other by a part `depth` of a cell along y, the upper one
/// turned about y and moved by parts of a cell; what it bears in its middle.
template <int Dim>
struct Layers {
  static constexpr int across = 10, of_layer = Dim == 2 ? across : across * across;

  Layers(double depth, const Vec<Dim>& shift, double turn = 0)
  {
    std::vector<typename OverlapContact<Dim>::Cell> surface;
    std::vector<Vec<Dim>> places;
    for (int c = 0; c < 2 * of_layer; ++c) {
      // Cells of a layer are neighbours; the layers are not.
      const int layer = c / of_layer;
      const IndexVec<3> location(c % across, 5 * layer, c % of_layer / across);
      surface.push_back(cell_at<Dim>(c, location.head<Dim>()));
      IndexVec<Dim> lattice = location.head<Dim>();
      lattice[1] = 0;
      Vec<Dim> middle = lattice.template cast<double>() + layer * shift;
      middle[1] = layer * (1 - depth);
      for (int k = 0; k < corners<Dim>; ++k) {
        Vec<Dim> at = (middle + corner_at<Dim>(k)).cwiseProduct(size<Dim>());
        if constexpr (Dim == 3)
          if (layer == 1) {
            const Vec<3> about = (0.5 * (across - 1) * Vec<3>::Ones()).cwiseProduct(size<3>());
            const double x = at[0] - about[0], z = at[2] - about[2];
            at[0] = about[0] + std::cos(turn) * x + std::sin(turn) * z;
            at[2] = about[2] - std::sin(turn) * x + std::cos(turn) * z;
          }
        places.push_back(at);
      }
    }
    Mesh<Dim> mesh(places);
    OverlapContact<Dim> contact(MPI_COMM_SELF, surface, 2, BodyPairs(1), size<Dim>(),
                                IndexVec<Dim>::Zero());
    contact.find_pairs(mesh.nodes, skin);
    contact.measure(mesh.nodes);
    contact.add_forces(mesh.fields);
    const int middle = of_layer + (Dim == 2 ? across / 2 : across / 2 * (across + 1));
    for (int c = of_layer; c < 2 * of_layer; ++c)
      for (int k = 0; k < corners<Dim>; ++k)
        for (int d = 0; d < Dim; ++d) {
          const double force = mesh.fields.force_of(LocalIndex(corners<Dim> * c + k))[d];
          (d == 1 ? all : all_along) += force;
          if (c == middle) (d == 1 ? pushed : along) += force;
        }
  }
  /// In the middle, in 2 S_c.
  double pressure() const { return pushed / (2 * stiffness * face()); }
  static double face() { return size<Dim>().prod() / size<Dim>()[1]; }

  double pushed = 0, along = 0;   ///< N, the cell in the middle
  double all = 0, all_along = 0;  ///< N, the layer
};

/// Across a flush face the pressure is 2 kappa C times the depth over the size of a cell, however
/// the lattices of the two sides lie to each other.
template <int Dim>
void press_layers()
{
  for (const auto& [depth, shift] : std::to_array<std::pair<double, double>>(
           {{0.001, 0.0}, {0.001, 0.5}, {0.03, 0.0}, {0.03, 0.1}, {0.03, 0.5}, {0.03, 0.7}})) {
    const Layers<Dim> layers(depth, shift * Vec<Dim>::Unit(0));
    const OverlapShare one((1 - shift) * depth), other(shift * depth);
    const OverlapPotential potential(one.value + other.value);
    const double pressure = potential.pressure(one.value + other.value) *
                            ((1 - shift) * one.slope + shift * other.slope);
    EXPECT_NEAR(layers.pressure() / pressure, 1, 1e-8) << depth << " " << shift;
    // What slides on to the next cell feels no more than a ridge as steep as it is deep.
    EXPECT_LT(std::abs(layers.along / layers.pushed), depth) << shift;
    // A cell more at a face is half the onset less.
    const double beyond = depth - OverlapShare::onset;
    if (beyond > 0) {
      EXPECT_LE(pressure, OverlapPotential(depth).pressure(depth));
      EXPECT_GE(pressure, 0.95 * OverlapPotential(beyond).pressure(beyond));
    }
  }
}

TEST(OverlapContact, PressesAlikeHoweverTheLatticesLie)
{
  press_layers<2>();
}

TEST(OverlapContactInSpace, PressesAlikeHoweverTheLatticesLie)
{
  press_layers<3>();
}

/// Layers that a hundredth of the modulus presses together meet within a hundredth of a location,
/// flush, moved and turned: nothing is felt before they touch.
TEST(OverlapContactInSpace, HoldsLayersApartHoweverTheyAreTurned)
{
  for (const double turn : {0.0, M_PI / 10, M_PI / 4})
    for (const Vec<3>& shift : {Vec<3>(0, 0, 0), Vec<3>(0.5, 0, 0.5), Vec<3>(0.3, 0, 0.2)}) {
      EXPECT_EQ((Layers<3>(-0.001, shift, turn).all), 0);
      const double depth = 0.02, onset = 0.5 * OverlapShare::onset;
      const Layers<3> layers(depth, shift, turn);
      // Each of the up to six cells under one counts for up to half an onset less.
      EXPECT_LE(layers.pressure(), 1.02 * OverlapPotential(depth).pressure(depth)) << turn;
      EXPECT_GE(layers.pressure(), OverlapPotential(depth - 5 * onset).pressure(depth - 5 * onset))
          << turn;
      EXPECT_LT(std::abs(layers.all_along), depth * layers.all) << turn;
    }
}

}  // namespace
}  // namespace mpm
