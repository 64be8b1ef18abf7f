// Cells of any shape at rest: patch test, and forces that are the gradient of an energy.
#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/materials/hencky.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<2> size(0.3, 0.2);
constexpr double thickness = 0.7, density = 1000;
constexpr LocalIndex across = 3, nodes_across = across + 1;

/// A block of cells whose corners stand up to a third of a location beside the lattice.
class Block {
 public:
  Block() : nodes_(corners(), std::vector<char>(16, 1), size, IndexVec<2>::Zero(), offsets())
  {
    auto law = make_hencky(PlaneAssumption::strain, {10.0, 0.3}, density, {});
    ParticleStore store(LocationCells<2>::columns(*law, true), law->state_columns(),
                        {"velocity", "mass", "initial_volume"});
    body_.emplace(Body<2>{"block", 0, density, std::move(law), std::move(store)});
    std::vector<LocationCells<2>::CellNodes> cells;
    for (LocalIndex j = 0; j < across; ++j)
      for (LocalIndex i = 0; i < across; ++i) {
        const LocalIndex first = i + nodes_across * j;
        cells.push_back({first, first + 1, first + nodes_across, first + nodes_across + 1});
        const LocalIndex p = body_->particles.add(GlobalIndex(cells.size()));
        body_->law->initialise(body_->particles.state(), p);
      }
    cells_.emplace(*body_, cells, size);
    cells_->take_rest(*body_, nodes_, thickness);
    cells_->keep_rest(*body_);
  }

  /// From rest in one step.
  void move(const std::function<Vec<2>(const Vec<2>&)>& displacement)
  {
    NodeFields<2> fields(nodes_.size(), mesh_needs<2>(false), 1.0);
    for (LocalIndex node = 0; node < nodes_.size(); ++node) {
      const Vec<2> moved = displacement(nodes_.position(node));
      for (int d = 0; d < 2; ++d) fields.updated_of(node)[d] = moved[d];
    }
    nodes_.move(fields, 1);
    LaneVector<double> forces(
        std::size_t(body_->particles.blocks()) * LocationCells<2>::block_values, 0.0);
    EXPECT_FALSE(cells_->update(*body_, nodes_, 1, forces.data()));
    forces_.assign(16, Vec<2>::Zero());
    for (LocalIndex p = 0; p < body_->particles.size(); ++p)
      for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 2; ++d) {
          const LocalIndex node = cells_->nodes_of(p)[std::size_t(c)];
          forces_[std::size_t(node)][d] +=
              forces[LocationCells<2>::force_at(p, c) + std::size_t(d)];
        }
  }
  double energy() const
  {
    double sum = cells_->bending_energy(*body_, nodes_);
    for (LocalIndex p = 0; p < body_->particles.size(); ++p)
      sum += body_->law->elastic_energy(
          body_->particles.state().block(p / lane_count))[p % lane_count];
    return sum;
  }
  std::vector<LocalIndex> beyond_stretch(double limit) const
  {
    return cells_->find_failed(*body_, {.stretch = limit});
  }
  double energy_of(LocalIndex cell) const { return cells_->stored_energy(*body_, nodes_, cell); }
  void erase(const std::vector<LocalIndex>& cells)
  {
    LaneVector<double> least_stretches;
    cells_->find_least_stretches(nodes_, least_stretches);
    cells_->erase(*body_, cells, least_stretches);
    LaneVector<double> found;
    cells_->find_least_stretches(nodes_, found);
    ASSERT_EQ(least_stretches.size(), found.size());
    for (LocalIndex p = 0; p < body_->particles.size(); ++p)
      EXPECT_EQ(least_stretches[std::size_t(p)], found[std::size_t(p)]);
  }
  double wave_speed() const
  {
    LaneVector<double> least_stretches;
    cells_->find_least_stretches(nodes_, least_stretches);
    return cells_->wave_speed_at_rest(*body_, least_stretches, 0);
  }
  const std::vector<Vec<2>>& forces() const { return forces_; }
  const ParticleStore& particles() const { return body_->particles; }
  const Law<2>& law() const { return *body_->law; }

  static bool within(LocalIndex node)
  {
    const LocalIndex i = node % nodes_across, j = node / nodes_across;
    return i > 0 && i < across && j > 0 && j < across;
  }

 private:
  static std::vector<IndexVec<2>> corners()
  {
    std::vector<IndexVec<2>> list;
    for_each_index(IndexBox<2>{IndexVec<2>::Zero(), IndexVec<2>::Constant(nodes_across)},
                   [&](const IndexVec<2>& at) { list.push_back(at); });
    return list;
  }
  static CornerOffsets<2> offsets()
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> around(-0.3, 0.3);
    CornerOffsets<2> offsets;
    for (const IndexVec<2>& corner : corners()) {
      const double x = around(random) * size[0];
      offsets.add(corner, {x, around(random) * size[1]});
    }
    offsets.seal();
    return offsets;
  }

  MeshNodes<2> nodes_;
  std::optional<Body<2>> body_;
  std::optional<LocationCells<2>> cells_;
  std::vector<Vec<2>> forces_;
};

TEST(FittedCells, AreWithoutForceAndEnergyAtRest)
{
  Block block;
  block.move([](const Vec<2>&) { return Vec<2>::Zero(); });
  for (const Vec<2>& force : block.forces()) EXPECT_LT(force.norm(), 1e-14);
  EXPECT_NEAR(block.energy(), 0, 1e-26);
}

TEST(FittedCells, KeepAUniformStressInAnAffineMotion)
{
  Block block;
  Eigen::Matrix2d gradient;
  gradient << 0.1, -0.3, 0.2, -0.15;
  block.move([&](const Vec<2>& x) -> Vec<2> { return gradient * x; });
  const double ratio = (Eigen::Matrix2d::Identity() + gradient).determinant();
  for (LocalIndex node = 0; node < 16; ++node)
    if (Block::within(node)) {
      EXPECT_LT(block.forces()[std::size_t(node)].norm(), 1e-14) << node;
    }
  alignas(lane_alignment) double first[6 * lane_count], stress[6 * lane_count];
  block.law().cauchy_stress(block.particles().state().block(0), first);
  for (LocalIndex p = 0; p < block.particles().size(); ++p) {
    const double* state = block.particles().state().block(p / lane_count);
    block.law().cauchy_stress(state, stress);
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(stress[k * lane_count + p % lane_count], first[k * lane_count], 1e-13);
    // What snapshots show is relative to rest.
    EXPECT_NEAR(block.law().volume_ratio(state)[p % lane_count], ratio, 1e-14);
  }
}

TEST(FittedCells, HaveTheMassOfTheirArea)
{
  const Block block;
  double mass = 0, volume = 0;
  for (LocalIndex p = 0; p < block.particles().size(); ++p) {
    mass += block.particles().motion()(block.particles().motion().find("mass"), p);
    volume += block.particles().state()(0, p);
    EXPECT_GT(block.particles().state()(0, p), 0);
  }
  EXPECT_NEAR(mass, density * volume, 1e-10);
}

TEST(FittedCells, HaveForcesThatAreTheGradientOfTheirEnergy)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> around(-0.02, 0.02);
  std::vector<Vec<2>> moved;
  for (int k = 0; k < 16; ++k) moved.emplace_back(around(random), around(random));
  const auto at = [&](int node, int axis, double more) {
    auto block = std::make_unique<Block>();
    int next = 0;
    block->move([&](const Vec<2>&) {
      Vec<2> u = moved[std::size_t(next)];
      if (next++ == node) u[axis] += more;
      return u;
    });
    return block;
  };
  const auto here = at(-1, 0, 0);
  ASSERT_GT(here->energy(), 1e-3);
  constexpr double step = 1e-6;
  for (int node = 0; node < 16; ++node)
    for (int axis = 0; axis < 2; ++axis) {
      const double slope =
          (at(node, axis, step)->energy() - at(node, axis, -step)->energy()) / (2 * step);
      EXPECT_NEAR(here->forces()[std::size_t(node)][axis], -slope, 1e-7) << node << ", " << axis;
    }
}

/// So that there is a time step in which it may come back.
TEST(FittedCells, WithACornerThatIsTurnedThroughHaveAWaveSpeed)
{
  Block block;
  int next = 0;
  block.move([&](const Vec<2>&) -> Vec<2> {
    const Vec<2> moved = next++ == nodes_across + 1 ? Vec<2>(-0.75 * size) : Vec<2>::Zero();
    return moved;
  });
  EXPECT_GT(block.wave_speed(), 99 * block.law().wave_speed());
  EXPECT_LT(block.wave_speed(), 300 * block.law().wave_speed());
}

TEST(FittedCells, FailByTheirStretchSinceRest)
{
  Block block;
  EXPECT_TRUE(block.beyond_stretch(1 + 1e-12).empty());
  const Eigen::Rotation2Dd turn(0.7), along(0.3);
  const Eigen::Matrix2d stretch =
      turn * along * Eigen::Vector2d(1.2, 0.9).asDiagonal() * along.inverse().toRotationMatrix();
  block.move([&](const Vec<2>& x) -> Vec<2> { return stretch * x - x; });
  EXPECT_TRUE(block.beyond_stretch(1.2 + 1e-12).empty());
  EXPECT_EQ(block.beyond_stretch(1.2 - 1e-12).size(), std::size_t(across * across));
}

TEST(FittedCells, LeaveTheEnergyOfTheOthersWhenTheyAreErased)
{
  Block block;
  block.move([](const Vec<2>& x) -> Vec<2> { return {0.2 * x[0] * x[1], 0.3 * x[0] * x[0]}; });
  const double whole = block.energy();
  const std::vector<LocalIndex> erased{0, 3, 4, 8};
  double gone = 0;
  for (const LocalIndex cell : erased) gone += block.energy_of(cell);
  EXPECT_GT(gone, 0);
  block.erase(erased);
  EXPECT_EQ(block.particles().size(), across * across - 4);
  EXPECT_NEAR(block.energy(), whole - gone, 1e-14 * whole);
}

}  // namespace
}  // namespace mpm
