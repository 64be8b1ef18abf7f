// Cells that are pieces of a wall, bent and drawn far beyond yield: plastic moment, energy, both
// laws.
#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<2> size(2e-6, 1e-6);
constexpr double volume = 2e-12, density = 1500;
const IsotropicConstants elastic{10e9, 0.3};
const YieldConstants yield{1e6, 0};

using MakeLaw = std::function<std::unique_ptr<Law<2>>(PlaneAssumption)>;

/// A cell whose corners are led. Its fibres, `size[0]` long, lie along x, or along y if it is
/// turned: all that is said of x and y here is said of the cell before.
class BentCell {
 public:
  BentCell(std::unique_ptr<Law<2>> law, bool turned)
      : turned_(turned),
        body_{"wall", 0, density, std::move(law), store_of()},
        nodes_({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {1, 1, 1, 1}, size_as_it_lies(),
               IndexVec<2>::Zero()),
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
    cells_.emplace(body_, std::span(&corners, 1), size_as_it_lies());
  }

  /// Bends by `curvature` (1/m) more: fibres along x at distance y are strained by curvature y; and
  /// draws them all by `strain` more, with sides that are free.
  void bend(double curvature, double strain = 0)
  {
    const double move = curvature * size[0] * size[1] / 4;  // of a corner along x
    // Half of what takes the stress across away, if the cell is elastic.
    const double across = (force(2, 1) + force(3, 1)) / size[0];  // Pa
    const double narrower = 0.5 * across / elastic.in_plane_modulus(PlaneAssumption::strain);
    double way[4][2];
    for (int corner = 0; corner < 4; ++corner) {
      const double right = corner % 2 ? 0.5 : -0.5, up = corner / 2 ? 0.5 : -0.5;
      way[corner][0] = (corner == 0 || corner == 3 ? move : -move) + right * strain * size[0];
      way[corner][1] = strain != 0 ? up * narrower * size[1] : 0;
      for (int d = 0; d < 2; ++d) fields_.updated_of(lies(corner))[along(d)] = way[corner][d] / dt;
    }
    const auto before = forces_;
    nodes_.move(fields_, dt);
    ASSERT_FALSE(cells_->update(body_, nodes_, dt, forces_.data()));
    for (int corner = 0; corner < 4; ++corner)
      for (int d = 0; d < 2; ++d)
        work_ -= 0.5 * (before[at(corner, d)] + forces_[at(corner, d)]) * way[corner][d];
  }

  /// N m: two forces on either end, a thickness apart.
  double moment() const { return 0.5 * (force(2, 0) - force(0, 0)) * size[1]; }
  /// N, along the fibres.
  double normal_force() const { return -(force(1, 0) + force(3, 0)); }
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
  Vec<2> size_as_it_lies() const { return turned_ ? Vec<2>(size[1], size[0]) : size; }
  int along(int d) const { return turned_ ? 1 - d : d; }
  int lies(int corner) const { return turned_ ? corner / 2 + 2 * (corner % 2) : corner; }
  std::size_t at(int corner, int d) const
  {
    return LocationCells<2>::force_at(0, lies(corner)) + std::size_t(along(d));
  }
  double force(int corner, int d) const { return forces_[at(corner, d)]; }
  static ParticleStore store_of() { return {{{"position", 2, "m"}}, {{"volume", 1, "m3"}}, {}}; }

  bool turned_;
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
  bool turned = false;
};

void PrintTo(const Case& c, std::ostream* out)
{
  *out << c.name;
}

class PlasticBending : public ::testing::TestWithParam<Case> {};

TEST_P(PlasticBending, StopsAtThePlasticMomentAndDissipatesWhatIsNotStored)
{
  const Case& c = GetParam();
  BentCell cell(c.make(c.plane), c.turned);
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

/// Over the plastic moment, as the wall is bent more and more, and over the plastic force.
struct Borne {
  std::vector<double> moments;
  double force;
  double most_bent;  // curvature at the end, over that at which a section's outermost fibres yield
};
/// What a wall of `cells` cells across bears that is bent around a line `shift` of half of it away
/// from its middle: each cell is drawn by as much as it is away from there.
Borne bear(const Case& c, int cells, double shift)
{
  const double held = c.plane == PlaneAssumption::strain ? 2 / std::sqrt(3.0) : 1.0;
  const double thickness = cells * size[1];
  const double curvature = 40 * held * yield.yield_stress / elastic.youngs_modulus / thickness;
  constexpr int steps = 8000;
  const double full = held * yield.yield_stress * thickness;
  Borne borne{std::vector<double>(steps, 0.0), 0,
              curvature * elastic.bending_modulus(c.plane) * thickness * thickness / (2 * full)};
  for (int k = 0; k < cells; ++k) {
    BentCell cell(c.make(c.plane), c.turned);
    const double from_middle = (k + 0.5) * size[1] - 0.5 * thickness;
    for (double& moment : borne.moments) {
      cell.bend(curvature / steps, curvature / steps * (from_middle + 0.5 * shift * thickness));
      moment += (cell.moment() + from_middle * cell.normal_force()) / (0.25 * full * thickness);
    }
    borne.force += cell.normal_force() / full;
    EXPECT_NEAR((cell.stored() + cell.dissipated()) / cell.work(), 1, 2e-3);
  }
  return borne;
}

/// A section's fibres yield one by one from the outermost on; those of a cell do together, which
/// bears more until all yields. How much follows from the yield surface of cells (docs/theory.md),
/// integrated by itself.
TEST_P(PlasticBending, WallsOfSeveralCellsStopAtThePlasticMomentToo)
{
  const struct {
    int cells;
    double more;  // over the section's moment, at most
  } expected[] = {{1, 0.174}, {2, 0.144}, {4, 0.038}, {8, 0.010}};
  for (const auto& [cells, more] : expected) {
    const Borne borne = bear(GetParam(), cells, 0);
    const double step = borne.most_bent / double(borne.moments.size());
    double most = 0, bent = 0;
    for (const double moment : borne.moments) {
      bent += step;
      const double section = bent < 1 ? bent / 1.5 : 1 - 1 / (3 * bent * bent);
      if (bent > 0.5) most = std::max(most, moment / section - 1);
    }
    EXPECT_NEAR(most, more, 0.01) << cells << " cells";
    EXPECT_NEAR(borne.moments.back(), 1, 0.01) << cells << " cells";
  }
}

/// A section that yields all through on both sides of that line.
TEST_P(PlasticBending, WallsThatAreDrawnBearLessMoment)
{
  for (const int cells : {1, 2, 3})
    for (const double shift : {0.3, 0.6, 0.9}) {
      const Borne borne = bear(GetParam(), cells, shift);
      EXPECT_NEAR(borne.force, shift, 0.02) << cells << " cells";
      EXPECT_NEAR(borne.moments.back(), 1 - shift * shift, 0.02) << cells << " cells";
    }
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
                      Case{"HypoelasticPlaneStress", hypoelastic, PlaneAssumption::stress},
                      Case{"HenckyPlaneStrainTurned", hencky, PlaneAssumption::strain, true},
                      Case{"HenckyPlaneStressTurned", hencky, PlaneAssumption::stress, true},
                      Case{"HypoelasticPlaneStressTurned", hypoelastic, PlaneAssumption::stress,
                           true}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace mpm
