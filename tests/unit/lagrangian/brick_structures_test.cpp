// Structures of bricks, one, two and four of them thick, against exact solutions: stiffnesses of
// one brick, by differences, put together.
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/hencky.hpp>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <functional>

#include "led_brick.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

const IsotropicConstants elastic{10.0, 0.3};

class Structure {
 public:
  Structure(const IndexVec<3>& cells, const Vec<3>& size) : cells_(cells), size_(size)
  {
    nodes_ = (cells.array() + 1).prod();
    load_ = Eigen::VectorXd::Zero(3 * nodes_);
    held_.assign(std::size_t(3 * nodes_), false);
    const Eigen::Matrix<double, 24, 24> brick = stiffness_of_brick();
    for (int z = 0; z < cells[2]; ++z)
      for (int y = 0; y < cells[1]; ++y)
        for (int x = 0; x < cells[0]; ++x)
          for (int a = 0; a < 24; ++a)
            for (int b = 0; b < 24; ++b)
              entries_.emplace_back(component(IndexVec<3>(x, y, z), a),
                                    component(IndexVec<3>(x, y, z), b), brick(a, b));
  }

  using Visit = std::function<void(int node, const Vec<3>& place)>;
  void for_each_node(const Visit& visit) const
  {
    for (int node = 0; node < nodes_; ++node) {
      const IndexVec<3> at(node % (cells_[0] + 1), node / (cells_[0] + 1) % (cells_[1] + 1),
                           node / ((cells_[0] + 1) * (cells_[1] + 1)));
      visit(node, at.cast<double>().cwiseProduct(size_));
    }
  }
  Vec<3> length() const { return cells_.cast<double>().cwiseProduct(size_); }
  void hold(int node, int d) { held_[std::size_t(3 * node + d)] = true; }
  double& load(int node, int d) { return load_[3 * node + d]; }

  /// Displacements under the loads.
  Eigen::VectorXd solve() const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& entry : entries_)
      if (!held_[std::size_t(entry.row())] && !held_[std::size_t(entry.col())])
        entries.push_back(entry);
    Eigen::VectorXd load = load_;
    for (int k = 0; k < 3 * nodes_; ++k)
      if (held_[std::size_t(k)]) {
        entries.emplace_back(k, k, 1.0);
        load[k] = 0;
      }
    Eigen::SparseMatrix<double> matrix(3 * nodes_, 3 * nodes_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(load);
  }

 private:
  int component(const IndexVec<3>& cell, int k) const
  {
    const IndexVec<3> at = cell + LocationMesh<3>::offset_of(k / 3);
    return 3 * (at[0] + (cells_[0] + 1) * (at[1] + (cells_[1] + 1) * at[2])) + k % 3;
  }
  Eigen::Matrix<double, 24, 24> stiffness_of_brick() const
  {
    LedBrick brick(make_hencky_solid(elastic, 1, {}), 1, size_);
    const BrickPlaces rest = brick.places();
    const double step = 1e-6 * size_.minCoeff();
    Eigen::Matrix<double, 24, 24> stiffness;
    for (int k = 0; k < 24; ++k) {
      const auto force_at = [&](double by) {
        BrickPlaces places = rest;
        places(k % 3, k / 3) += by;
        brick.lead_to(places);
        return brick.force();
      };
      const BrickPlaces difference = force_at(-step) - force_at(step);
      stiffness.col(k) = difference.reshaped() / (2 * step);
    }
    return 0.5 * (stiffness + stiffness.transpose());
  }

  IndexVec<3> cells_;
  Vec<3> size_;
  int nodes_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<bool> held_;
  Eigen::VectorXd load_;
};

constexpr double small = 1e-9;

/// A cantilever along x of length 20 and thickness 1, bent along z by a force of 1 at its end,
/// which is shared out as shear flows: deflection over that of a beam with shear (Timoshenko 1921).
double cantilever(int thick, int wide, bool held_along_y)
{
  const double length = 20, h = 1.0 / thick;
  Structure beam({20 * thick / 2, wide, thick}, {2 * h, h, h});
  const double width = wide * h;
  std::vector<int> end;
  beam.for_each_node([&](int node, const Vec<3>& at) {
    if (held_along_y) beam.hold(node, 1);
    if (at[0] < small) {
      // The section may change its shape: only its middle is held across.
      beam.hold(node, 0);
      if (std::abs(at[2] - 0.5) < 0.5 * h + small) beam.hold(node, 2);
      if (std::abs(at[1] - 0.5 * width) < 0.5 * h + small && at[2] < small) beam.hold(node, 1);
    }
    if (at[0] > length - small) end.push_back(node);
  });
  for (const int node : end) beam.load(node, 2) = 1.0 / double(end.size());
  const Eigen::VectorXd moved = beam.solve();
  double deflection = 0;
  for (const int node : end) deflection += moved[3 * node + 2] / double(end.size());
  const double nu = elastic.poisson_ratio;
  const double modulus = elastic.youngs_modulus / (held_along_y ? 1 - nu * nu : 1);
  const double bent = std::pow(length, 3) / (3 * modulus * width / 12),
               sheared = 1.2 * length / (elastic.shear_modulus() * width);
  return deflection / (bent + sheared);
}

TEST(BrickStructure, PlateOfAnyThicknessBendsAsACylinder)
{
  for (const int thick : {1, 2, 4})
    EXPECT_NEAR(cantilever(thick, 1, true), 1, 0.02) << thick << " thick";
}

TEST(BrickStructure, SquareBeamOfAnyThicknessBends)
{
  for (const int thick : {1, 2, 4})
    EXPECT_NEAR(cantilever(thick, thick, false), 1, 0.02) << thick << " thick";
}

/// Of a square with forces at its corners, up and down in turn, which twist it evenly:
/// w = c x y with c = 3 P / (G t^3) (Timoshenko & Woinowsky-Krieger 1959, sec. 11); a bar as wide
/// as long and as thin as this is softer by 0.63 t / b, which is 1 %.
TEST(BrickStructure, PlateTwists)
{
  constexpr int wide = 16;
  constexpr double side = 4, edge = wide * side;
  for (const int thick : {1, 2}) {
    Structure plate({wide, wide, thick}, {side, side, 1.0 / thick});
    const auto is_edge = [&](double at) { return at < small || at > edge - small; };
    double lifted = 0;
    std::vector<int> corners;
    plate.for_each_node([&](int node, const Vec<3>& at) {
      if (!is_edge(at[0]) || !is_edge(at[1])) return;
      const double sign = (at[0] < small) == (at[1] < small) ? 1 : -1;
      plate.load(node, 2) = sign / (thick + 1);
      corners.push_back(sign > 0 ? node : -node - 1);
      // Three corners at the bottom keep it from moving as a whole.
      if (at[2] > small) return;
      if (at[0] < small || at[1] < small) plate.hold(node, 2);
      if (at[0] < small && at[1] < small) plate.hold(node, 0), plate.hold(node, 1);
      if (at[0] > small && at[1] < small) plate.hold(node, 1);
    });
    const Eigen::VectorXd moved = plate.solve();
    for (const int corner : corners) {
      const int node = corner < 0 ? -corner - 1 : corner;
      lifted += (corner < 0 ? -1 : 1) * moved[3 * node + 2] / (thick + 1);
    }
    const double exact = 3 / elastic.shear_modulus() * edge * edge;
    EXPECT_NEAR(lifted / exact, 1, 0.02) << thick << " thick";
  }
}

/// What is stretched and sheared evenly bears the same stress everywhere: no force inside, and on
/// the faces that of the stress.
TEST(BrickStructure, PassesThePatchTest)
{
  const IndexVec<3> cells(3, 4, 3);
  const Vec<3> size(0.3, 0.2, 0.25);
  Structure block(cells, size);
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.4, -0.3, 0.2, -0.7, 0.5, -0.1, 0.6, 0.8;
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  const double mu = elastic.shear_modulus(), lambda = elastic.bulk_modulus() - 2 * mu / 3;
  const Eigen::Matrix3d stress =
      2 * mu * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
  const Vec<3> length = block.length();
  std::vector<Vec<3>> places;
  block.for_each_node([&](int node, const Vec<3>& at) {
    places.push_back(at);
    for (int d = 0; d < 3; ++d) {
      // Of the faces normal to d: an equal part to the four corners of every brick's face.
      const bool lower = at[d]<small, upper = at[d]> length[d] - small;
      if (!lower && !upper) continue;
      double area = 1;
      for (int e = 0; e < 3; ++e)
        if (e != d) area *= (at[e] < small || at[e] > length[e] - small ? 0.5 : 1.0) * size[e];
      for (int i = 0; i < 3; ++i) block.load(node, i) += (upper ? area : -area) * stress(i, d);
    }
    if (node == 0)
      for (int d = 0; d < 3; ++d) block.hold(node, d);
    if (node == cells[0]) block.hold(node, 1), block.hold(node, 2);
    if (node == (cells[0] + 1) * cells[1]) block.hold(node, 2);
  });
  const Eigen::VectorXd moved = block.solve();
  // Up to a rotation: the strain between any two nodes.
  for (std::size_t k = 1; k < places.size(); ++k) {
    const Vec<3> from = places[k] - places[0];
    const Vec<3> apart = moved.segment<3>(Eigen::Index(3 * k)) - moved.segment<3>(0);
    ASSERT_NEAR(from.dot(apart), from.dot(strain * from), 1e-7) << k;
  }
}

}  // namespace
}  // namespace mpm
