// Layers of cells that are pressed and slide upon each other.
#include <cmath>
#include <utility>

#include "contact_cells.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

/// Two layers of cells that lie upon each other by a part `depth` of a cell along y, the upper one
/// turned about y and moved by parts of a cell; what it bears in its middle.
template <int Dim>
struct Layers {
  static constexpr int across = 10, of_layer = Dim == 2 ? across : across * across;

  /// `slide`: m/s, of the upper layer, with friction of 0.3; `squeezed`: all heights, over those of
  /// cells at rest.
  Layers(double depth, const Vec<Dim>& shift, double turn = 0,
         const Vec<Dim>& slide = Vec<Dim>::Zero(), double squeezed = 1)
  {
    typename OverlapContact<Dim>::Cells surface;
    std::vector<Vec<Dim>> places;
    for (int c = 0; c < 2 * of_layer; ++c) {
      // Cells of a layer are neighbours; the layers are not.
      const int layer = c / of_layer;
      const IndexVec<3> location(c % across, 5 * layer, c % of_layer / across);
      surface.cells.push_back(cell_at<Dim>(c, location.head<Dim>()));
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
        at[1] *= squeezed;
        places.push_back(at);
      }
    }
    Mesh<Dim> mesh(places);
    BodyPairs bodies(1);
    bodies.add(0, 0, 0.3);
    OverlapContact<Dim> contact(MPI_COMM_SELF, surface, 2, bodies, size<Dim>(),
                                IndexVec<Dim>::Zero());
    contact.find_pairs(mesh.nodes, rooms(mesh.nodes));
    contact.measure(mesh.nodes);
    contact.add_forces(mesh.fields);
    for (LocalIndex n = 0; n < mesh.nodes.size(); ++n) {
      mesh.fields.mass_of(n) = 1;
      for (int d = 0; d < Dim; ++d)
        mesh.fields.updated_of(n)[d] = n < corners<Dim> * of_layer ? 0 : slide[d];
    }
    std::vector<double> friction(places.size() * Dim, 0.0);
    contact.add_friction(mesh.fields, 1e-9, friction);
    for (std::size_t n = places.size() / 2; n < places.size(); ++n)
      for (int d = 0; d < Dim; ++d) rubbed[d] += friction[n * Dim + std::size_t(d)];
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

  double pushed = 0, along = 0;        ///< N, the cell in the middle
  double all = 0, all_along = 0;       ///< N, the layer
  Vec<Dim> rubbed = Vec<Dim>::Zero();  ///< N, the layer, by friction
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

/// Cells of half the height that lie upon each other by the same part of it store the same energy
/// per cell, and press twice as hard.
template <int Dim>
void press_squeezed_layers()
{
  for (const double shift : {0.0, 0.3}) {
    const Vec<Dim> along = shift * Vec<Dim>::Unit(0), still = Vec<Dim>::Zero();
    const Layers<Dim> whole(0.03, along), half(0.03, along, 0, still, 0.5);
    EXPECT_NEAR(half.pressure() / whole.pressure(), 2, 1e-9) << shift;
    // Beyond a tenth of their volume they do not become stiffer: the depth is a tenth of that.
    const Layers<Dim> tenth(0.03, along, 0, still, 0.1), less(0.06, along, 0, still, 0.05);
    EXPECT_NEAR(less.pressure() / tenth.pressure(), 1, 1e-9) << shift;
  }
}

TEST(OverlapContact, PressesAlikeHoweverTheLatticesLie)
{
  press_layers<2>();
}

TEST(OverlapContact, IsAsMuchStifferAsItsCellsAreSqueezed)
{
  press_squeezed_layers<2>();
}

TEST(OverlapContactInSpace, IsAsMuchStifferAsItsCellsAreSqueezed)
{
  press_squeezed_layers<3>();
}

TEST(OverlapContactInSpace, PressesAlikeHoweverTheLatticesLie)
{
  press_layers<3>();
}

/// Flush layers that slide bear friction against their way.
TEST(OverlapContact, RubsAgainstTheWay)
{
  const Layers<2> layers(0.03, Vec<2>::Zero(), 0, Vec<2>(-2, 0));
  EXPECT_NEAR(layers.rubbed[0] / layers.all, 0.3, 1e-9);
  EXPECT_NEAR(layers.rubbed[1] / layers.all, 0, 1e-9);
}

TEST(OverlapContactInSpace, RubsAgainstTheWay)
{
  for (const Vec<3>& way : {Vec<3>(1, 0, 0), Vec<3>(0, 0, -1), Vec<3>(0.6, 0, 0.8)}) {
    const Layers<3> layers(0.03, Vec<3>::Zero(), 0, 2 * way);
    EXPECT_LT((layers.rubbed / layers.all + 0.3 * way).norm(), 1e-9) << way.transpose();
  }
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
