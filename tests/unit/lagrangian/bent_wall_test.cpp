// One cell that is a piece of a wall, bent far beyond yield: plastic moment, energy, both laws.
#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<2> size(2e-6, 1e-6);
constexpr double volume = 2e-12, density = 1500;
const IsotropicConstants elastic{10e9, 0.3};
const YieldConstants yield{100e6, 0};

using MakeLaw = std::function<std::unique_ptr<Law<2>>(PlaneAssumption)>;

/// A cell whose corners are led.
class BentCell {
 public:
  explicit BentCell(std::unique_ptr<Law<2>> law)
      : body_{"wall", 0, density, std::move(law), store_of()},
        nodes_({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {1, 1, 1, 1}, size, IndexVec<2>::Zero()),
        fields_(4, {.gradient = false}, 0),
        forces_(LocationCells<2>::block_values, 0.0)
  {
    body_.particles =
        ParticleStore(LocationCells<2>::columns(*body_.law), body_.law->state_columns(),
                      {"velocity", "mass", "initial_volume", "plastic_work"});
    body_.particles.add(0);
    body_.particles.state()(0, 0) = volume;
    body_.law->initialise(body_.particles.state(), 0);
    LocationCells<2>::initialise(body_.particles.motion(), 0);
    body_.particles.seal();
    const LocationCells<2>::CellNodes corners{0, 1, 2, 3};
    cells_.emplace(body_, std::span(&corners, 1), size);
  }

  /// Bends by `curvature` (1/m) more: fibres along x at distance y are strained by curvature y.
  void bend(double curvature)
  {
    const double move = curvature * size[0] * size[1] / 4;  // of a corner along x
    for (LocalIndex node = 0; node < 4; ++node)
      fields_.updated_of(node)[0] = (node == 0 || node == 3 ? move : -move) / dt;
    const auto before = forces_;
    nodes_.move(fields_, dt);
    ASSERT_FALSE(cells_->update(body_, nodes_, dt, forces_.data()));
    for (int corner = 0; corner < 4; ++corner) {
      const std::size_t at = std::size_t(2 * corner * lane_count);
      work_ -= 0.5 * (before[at] + forces_[at]) * (corner == 0 || corner == 3 ? move : -move);
    }
  }

  /// N m: two forces on either end, a thickness apart.
  double moment() const
  {
    return 0.5 * std::abs(forces_[0] - forces_[2 * 2 * lane_count]) * size[1];
  }
  double stored() const
  {
    return cells_->bending_energy(body_, nodes_) +
           body_.law->elastic_energy(body_.particles.state().block(0))[0];
  }
  double dissipated() const
  {
    const int column = body_.particles.state().find("plastic_work");
    return body_.particles.state()(column, 0);
  }
  double work() const { return work_; }

 private:
  static constexpr double dt = 1e-9;
  static ParticleStore store_of() { return {{{"position", 2, "m"}}, {{"volume", 1, "m3"}}, {}}; }

  Body<2> body_;
  MeshNodes<2> nodes_;
  NodeFields<2> fields_;
  LaneVector<double> forces_;
  std::optional<LocationCells<2>> cells_;
  double work_ = 0;
};

struct Case {
  const char* name;
  MakeLaw make;
  PlaneAssumption plane;
};

void PrintTo(const Case& c, std::ostream* out)
{
  *out << c.name;
}

class PlasticBending : public ::testing::TestWithParam<Case> {};

TEST_P(PlasticBending, StopsAtThePlasticMomentAndDissipatesWhatIsNotStored)
{
  const Case& c = GetParam();
  BentCell cell(c.make(c.plane));
  const double modulus = elastic.bending_modulus(c.plane);
  const double held = c.plane == PlaneAssumption::strain ? 2 / std::sqrt(3.0) : 1.0;
  // Force couple at the ends: 1 m thick, moment of a rectangle h^2 / 4 sy.
  const double plastic = held * yield.yield_stress * size[1] * size[1] / 4;
  const double first = plastic / (modulus * std::pow(size[1], 3) / 12);  // curvature at which
  constexpr int steps = 2000;
  for (int k = 0; k < steps; ++k) {
    cell.bend(3 * first / steps);
    if (k == steps / 4) {
      EXPECT_NEAR(cell.moment() / plastic, 0.75, 2e-3);
      EXPECT_EQ(cell.dissipated(), 0);
    }
  }
  EXPECT_NEAR(cell.moment() / plastic, 1, 2e-3);
  EXPECT_NEAR((cell.stored() + cell.dissipated()) / cell.work(), 1, 2e-3);
  EXPECT_NEAR(cell.dissipated() / (2 * plastic * first * size[0]), 1, 1e-2);
}

std::unique_ptr<Law<2>> hencky(PlaneAssumption plane)
{
  return make_hencky(plane, elastic, density, yield);
}
std::unique_ptr<Law<2>> hypoelastic(PlaneAssumption plane)
{
  return make_hypoelastic_von_mises(plane, elastic, yield, density);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, PlasticBending,
    ::testing::Values(Case{"HenckyPlaneStrain", hencky, PlaneAssumption::strain},
                      Case{"HenckyPlaneStress", hencky, PlaneAssumption::stress},
                      Case{"HypoelasticPlaneStrain", hypoelastic, PlaneAssumption::strain},
                      Case{"HypoelasticPlaneStress", hypoelastic, PlaneAssumption::stress}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace mpm
