#include <mpm/materials/plane_stiffness.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace mpm {

namespace {

/// From the 3D compliance in the order xx, yy, zz, xy: condense zz out.
PlaneStiffness condensed(PlaneAssumption plane, const Eigen::Matrix3d& normal_compliance,
                         double shear_modulus)
{
  PlaneStiffness s;
  s.in_plane.setZero();
  s.out_of_plane.setZero();
  s.thickness_strain.setZero();
  if (plane == PlaneAssumption::strain) {
    const Eigen::Matrix3d c = normal_compliance.inverse();
    s.in_plane.topLeftCorner<2, 2>() = c.topLeftCorner<2, 2>();
    s.out_of_plane.head<2>() = c.block<1, 2>(2, 0);
  } else {
    s.in_plane.topLeftCorner<2, 2>() = normal_compliance.topLeftCorner<2, 2>().inverse();
    s.thickness_strain.head<2>() = normal_compliance.block<1, 2>(2, 0);
  }
  s.in_plane(2, 2) = shear_modulus;
  return s;
}

}  // namespace

PlaneStiffness PlaneStiffness::isotropic(PlaneAssumption plane, const IsotropicConstants& k)
{
  const double off = -k.poisson_ratio / k.youngs_modulus;
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Constant(off);
  compliance.diagonal().setConstant(1 / k.youngs_modulus);
  return condensed(plane, compliance, k.shear_modulus());
}

PlaneStiffness PlaneStiffness::axis_out_of_plane(PlaneAssumption plane,
                                                 const TransverselyIsotropicConstants& k)
{
  const double tt = -k.transverse_poisson_ratio / k.transverse_modulus;
  const double ta = -k.axial_poisson_ratio / k.axial_modulus;
  Eigen::Matrix3d compliance;
  compliance << 1 / k.transverse_modulus, tt, ta,  //
      tt, 1 / k.transverse_modulus, ta,            //
      ta, ta, 1 / k.axial_modulus;
  return condensed(plane, compliance,
                   k.transverse_modulus / (2 * (1 + k.transverse_poisson_ratio)));
}

PlaneStiffness PlaneStiffness::axis_in_plane(PlaneAssumption plane,
                                             const TransverselyIsotropicConstants& k, double angle)
{
  const double tt = -k.transverse_poisson_ratio / k.transverse_modulus;
  const double ta = -k.axial_poisson_ratio / k.axial_modulus;
  Eigen::Matrix3d compliance;
  compliance << 1 / k.axial_modulus, ta, ta,  //
      ta, 1 / k.transverse_modulus, tt,       //
      ta, tt, 1 / k.transverse_modulus;
  PlaneStiffness s = condensed(plane, compliance, k.axial_shear_modulus);
  // Strain from the scene's axes to the material's: engineering shear.
  const double c = std::cos(angle), n = std::sin(angle);
  Eigen::Matrix3d t;
  t << c * c, n * n, n * c,  //
      n * n, c * c, -n * c,  //
      -2 * n * c, 2 * n * c, c * c - n * n;
  s.in_plane = (t.transpose() * s.in_plane * t).eval();
  s.out_of_plane = (s.out_of_plane * t).eval();
  // Stress to the material's axes is t^-T.
  s.thickness_strain = (s.thickness_strain * t.transpose().inverse()).eval();
  return s;
}

double PlaneStiffness::wave_modulus() const
{
  double largest = 0;
  constexpr int directions = 180;
  for (int k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * k / directions;
    const double x = std::cos(angle), y = std::sin(angle);
    Eigen::Matrix<double, 3, 2> b;  // strain of a wave front with normal (x, y)
    b << x, 0, 0, y, y, x;
    const Eigen::Matrix2d acoustic = b.transpose() * in_plane * b;
    largest = std::max(
        largest, Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(acoustic).eigenvalues().maxCoeff());
  }
  return largest;
}

}  // namespace mpm
