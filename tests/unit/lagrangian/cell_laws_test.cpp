// Cells of laws that are listed, against exact values: uniform deformation of a patch, and bending
// of one cell. Anisotropic ones against the compliance of the solid that they are cut from.
#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/materials/laws.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace mpm {
namespace {

const Vec<2> size(0.3, 0.2);
constexpr double volume = 0.06;
using Strain = Eigen::Vector3d;  ///< xx, yy, 2 xy

/// A square of `across` by `across` cells, whose corners are led.
class Patch {
 public:
  Patch(std::unique_ptr<Law<2>> law, int across)
      : across_(across),
        body_{"patch", 0, 1000, std::move(law), {{{"position", 2, "m"}}, {{"volume", 1, "m3"}}, {}}}
  {
    body_.particles = ParticleStore(LocationCells<2>::columns(*body_.law),
                                    body_.law->state_columns(), {"initial_volume"});
    std::vector<LocationCells<2>::CellNodes> corners;
    const int row = across + 1;
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        const LocalIndex p = body_.particles.add(LocalIndex(corners.size()));
        body_.particles.state()(0, p) = volume;
        body_.law->initialise(body_.particles.state(), p);
        LocationCells<2>::initialise(body_.particles.motion(), p);
        const int first = j * row + i;
        corners.push_back({first, first + 1, first + row, first + row + 1});
      }
    body_.particles.seal();
    std::vector<IndexVec<2>> lattice;
    for (int j = 0; j < row; ++j)
      for (int i = 0; i < row; ++i) lattice.emplace_back(i, j);
    corners_ = corners;
    nodes_.emplace(lattice, std::vector<char>(lattice.size(), 1), size, IndexVec<2>::Zero());
    cells_.emplace(body_, corners_, size);
  }

  /// Every node to where the motion takes it, in one step.
  void lead(const std::function<Vec<2>(const Vec<2>&)>& motion)
  {
    NodeFields<2> fields(nodes_->size(), {.gradient = false}, 0);
    for (LocalIndex node = 0; node < nodes_->size(); ++node) {
      const Vec<2> way = motion(nodes_->position(node)) - nodes_->position(node);
      for (int d = 0; d < 2; ++d) fields.updated_of(node)[d] = way[d];
    }
    nodes_->move(fields, 1);
    LaneVector<double> forces(
        std::size_t(body_.particles.blocks()) * LocationCells<2>::block_values, 0.0);
    ASSERT_FALSE(cells_->update(body_, *nodes_, 1, forces.data()));
    force_.assign(std::size_t(nodes_->size()), Vec<2>::Zero());
    for (std::size_t p = 0; p < corners_.size(); ++p)
      for (std::size_t c = 0; c < 4; ++c)
        for (int d = 0; d < 2; ++d)
          force_[std::size_t(corners_[p][c])][d] +=
              forces[LocationCells<2>::force_at(LocalIndex(p), int(c)) + std::size_t(d)];
  }

  /// Of the cells around a corner of the lattice, N.
  Vec<2> force(int i, int j) const { return force_[std::size_t(j * (across_ + 1) + i)]; }
  /// J
  double stored() const
  {
    double sum = cells_->bending_energy(body_, *nodes_);
    for (LocalIndex b = 0; b < body_.particles.blocks(); ++b)
      sum += stdx::reduce(body_.law->elastic_energy(body_.particles.state().block(b)));
    return sum;
  }

 private:
  int across_;
  Body<2> body_;
  std::vector<LocationCells<2>::CellNodes> corners_;
  std::optional<MeshNodes<2>> nodes_;
  std::optional<LocationCells<2>> cells_;
  std::vector<Vec<2>> force_;
};

constexpr int across = 3;

/// What a uniform first Piola-Kirchhoff stress does at the border, and nowhere else.
void expect_forces_of(const Eigen::Matrix2d& stress, const Patch& patch, double bound)
{
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= across; ++i) {
      const auto side = [](int at) { return at == 0 ? -1.0 : at == across ? 1.0 : 0.0; };
      const auto share = [](int at) { return at == 0 || at == across ? 0.5 : 1.0; };
      const Vec<2> area(side(i) * share(j) * size[1], side(j) * share(i) * size[0]);
      const double scale = stress.norm() * size.norm();
      EXPECT_LT((patch.force(i, j) + stress * area).norm(), bound * scale) << i << ", " << j;
    }
}

struct Case {
  const char* name;
  std::function<Eigen::Matrix3d()> stiffness;  ///< of small strains in the plane, Pa
  const char* law;
  ParameterValues values;
  PlaneAssumption plane;
};

using Compliance = Eigen::Matrix<double, 6, 6>;
/// Of engineering strains xx, yy, zz, xy, yz, xz by the stresses, with a unique axis along x.
Compliance transversely_isotropic(double e, double nu, double axial, double axial_nu, double shear)
{
  Compliance s = Compliance::Zero();
  s.diagonal() << 1 / axial, 1 / e, 1 / e, 1 / shear, 2 * (1 + nu) / e, 1 / shear;
  s(0, 1) = s(1, 0) = s(0, 2) = s(2, 0) = -axial_nu / axial;
  s(1, 2) = s(2, 1) = -nu / e;
  return s;
}

/// In axes turned by a rotation: stress' = Q stress Q^T.
Compliance turned(const Compliance& s, const Eigen::Matrix3d& q)
{
  constexpr int row[] = {0, 1, 2, 0, 1, 0}, column[] = {0, 1, 2, 1, 2, 2};
  Compliance of_stress;  // Voigt's stresses in the old axes by those in the new ones
  for (int k = 0; k < 6; ++k) {
    Eigen::Matrix3d unit = Eigen::Matrix3d::Zero();
    unit(row[k], column[k]) = unit(column[k], row[k]) = 1;
    const Eigen::Matrix3d old = q.transpose() * unit * q;
    for (int m = 0; m < 6; ++m) of_stress(m, k) = old(row[m], column[m]);
  }
  return of_stress.transpose() * s * of_stress;
}

/// xx, yy, xy with the others' strain or stress 0.
Eigen::Matrix3d in_plane(const Compliance& s, PlaneAssumption plane)
{
  const std::array<int, 3> kept{0, 1, 3};
  if (plane == PlaneAssumption::stress) return Eigen::Matrix3d(s(kept, kept)).inverse();
  return Compliance(s.inverse())(kept, kept);
}

constexpr double e = 10e9, nu = 0.3, axial = 35e9, axial_nu = 0.4, shear = 3.5e9, angle = 0.5;

Case fibres(const char* name, PlaneAssumption plane, bool lying)
{
  ParameterValues values{{"density", 1000.0},
                         {"youngs_modulus", e},
                         {"poisson_ratio", nu},
                         {"axial_modulus", axial},
                         {"axial_poisson_ratio", axial_nu},
                         {"axial_shear_modulus", shear},
                         {"unique_axis", std::string(lying ? "in_plane" : "out_of_plane")}};
  if (lying) values.set("axis_angle", angle);
  return {name,
          [=] {
            const Eigen::Matrix3d turn =
                lying ? Eigen::AngleAxisd(angle, Vec<3>::UnitZ()).toRotationMatrix()
                      : Eigen::AngleAxisd(-std::acos(0.0), Vec<3>::UnitY()).toRotationMatrix();
            return in_plane(turned(transversely_isotropic(e, nu, axial, axial_nu, shear), turn),
                            plane);
          },
          "transversely_isotropic", values, plane};
}

Case isotropic(const char* name, const char* law, PlaneAssumption plane)
{
  return {name,
          [=] { return in_plane(transversely_isotropic(e, nu, e, nu, e / (2 * (1 + nu))), plane); },
          law,
          {{"density", 1000.0}, {"youngs_modulus", e}, {"poisson_ratio", nu}},
          plane};
}

void PrintTo(const Case& c, std::ostream* out)
{
  *out << c.name;
}

class CellsOfALaw : public ::testing::TestWithParam<Case> {
 protected:
  static Patch patch(int across)
  {
    const Case& c = GetParam();
    ParameterValues values = c.values;
    const OneOf<LawRow> law(c.law);
    fill_defaults(*law, values);
    return Patch(make_law<2>(*law, values, c.plane), across);
  }
  /// Energies of rubber are differences, to 1e-16 of the modulus.
  static constexpr double small = 1e-5;
};

TEST_P(CellsOfALaw, CarryAUniformStressInASmallUniformStrain)
{
  for (const Strain& strain :
       {Strain(1, 0, 0), Strain(0, 1, 0), Strain(0, 0, 1), Strain(0.7, -0.4, 0.9)}) {
    Patch patch = this->patch(across);
    Eigen::Matrix2d gradient;
    gradient << strain[0], 0.5 * strain[2], 0.5 * strain[2], strain[1];
    patch.lead([&](const Vec<2>& at) { return Vec<2>(at + small * gradient * at); });
    const Eigen::Vector3d s = GetParam().stiffness() * (small * strain);
    Eigen::Matrix2d stress;
    stress << s[0], s[2], s[2], s[1];
    expect_forces_of(stress, patch, 1e-4);  // what is of the order of the strain
    const double energy = 0.5 * small * s.dot(strain) * volume * across * across;
    EXPECT_NEAR(patch.stored() / energy, 1, 1e-4);
  }
}

/// Fibres along an axis at distance y from the middle are strained by c y, and bear no stress
/// across.
TEST_P(CellsOfALaw, BendWithTheStiffnessOfFibresWithoutStressAcross)
{
  const Eigen::Matrix3d compliance = GetParam().stiffness().inverse();
  for (int axis = 0; axis < 2; ++axis) {
    Patch cell = patch(1);
    constexpr double c = small / 0.3;
    cell.lead([&](const Vec<2>& at) {
      Vec<2> to = at;
      const Vec<2> from = at - 0.5 * size;
      to[axis] += c * from[0] * from[1];
      return to;
    });
    const double thickness = size[1 - axis];
    const double per_length = std::pow(thickness, 3) / (12 * compliance(axis, axis));
    EXPECT_NEAR(cell.stored() / (0.5 * per_length * c * c * size[axis]), 1, 1e-6);
    // A couple of two forces, a thickness apart, at either end.
    for (const int i : {0, 1})
      for (const int j : {0, 1})
        EXPECT_NEAR(cell.force(i, j)[axis] * thickness / (per_length * c), i == j ? -1 : 1, 1e-4);
  }
}

/// Far from rest: tau = mu (b - I) + lambda ln J I (Bonet & Wood 2008, 6.4.3), in plane stress with
/// the thickness at which tau_zz is 0.
TEST(NeoHookeanCells, CarryTheExactStressOfAnyUniformDeformation)
{
  const double mu = e / (2 * (1 + nu)), lambda = e * nu / ((1 + nu) * (1 - 2 * nu));
  Eigen::Matrix2d f;
  f << 1.4, 0.5, -0.2, 0.7;
  const Eigen::Matrix2d b = f * f.transpose();
  for (const PlaneAssumption plane : {PlaneAssumption::strain, PlaneAssumption::stress}) {
    double log_j = std::log(f.determinant());
    if (plane == PlaneAssumption::stress) {
      double lower = -1, upper = 1;  // of ln of the stretch across
      while (upper - lower > 1e-15) {
        const double z = 0.5 * (lower + upper);
        const double tau = mu * (std::exp(2 * z) - 1) + lambda * (log_j + z);
        (tau < 0 ? lower : upper) = z;
      }
      log_j += lower;
    }
    const Eigen::Matrix2d stress =
        (mu * (b - Eigen::Matrix2d::Identity()) + lambda * log_j * Eigen::Matrix2d::Identity()) *
        f.transpose().inverse();
    const OneOf<LawRow> law("neo_hookean");
    Patch patch(
        make_law<2>(*law, {{"density", 1000.0}, {"youngs_modulus", e}, {"poisson_ratio", nu}},
                    plane),
        across);
    patch.lead([&](const Vec<2>& at) { return Vec<2>(f * at); });
    expect_forces_of(stress, patch, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, CellsOfALaw,
    ::testing::Values(fibres("FibresAcrossThePlaneInPlaneStrain", PlaneAssumption::strain, false),
                      fibres("FibresAcrossThePlaneInPlaneStress", PlaneAssumption::stress, false),
                      fibres("FibresInThePlaneInPlaneStrain", PlaneAssumption::strain, true),
                      fibres("FibresInThePlaneInPlaneStress", PlaneAssumption::stress, true),
                      isotropic("NeoHookeanInPlaneStrain", "neo_hookean", PlaneAssumption::strain),
                      isotropic("NeoHookeanInPlaneStress", "neo_hookean", PlaneAssumption::stress),
                      isotropic("HenckyInPlaneStrain", "isotropic", PlaneAssumption::strain),
                      isotropic("HenckyInPlaneStress", "isotropic", PlaneAssumption::stress)),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace mpm
