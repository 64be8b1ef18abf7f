#pragma once
/// Linear elastic stiffness of a plane model, isotropic or transversely isotropic.

#include <mpm/materials/elastic_constants.hpp>

#include <Eigen/Core>

namespace mpm {

/// Transversely isotropic constants, Pa: `transverse` in the isotropic plane, `axial` along the
/// unique axis; axial_poisson_ratio = - strain_T / strain_A under axial load.
struct TransverselyIsotropicConstants {
  double transverse_modulus;
  double transverse_poisson_ratio;
  double axial_modulus;
  double axial_poisson_ratio;
  double axial_shear_modulus;
};

struct PlaneStiffness {
  /// Stress (xx, yy, xy) from strain (xx, yy, engineering shear), Pa.
  Eigen::Matrix3d in_plane;
  /// sigma_zz from the same strain in plane strain; zero in plane stress.
  Eigen::RowVector3d out_of_plane;
  /// Strain zz from stress (xx, yy, xy) in plane stress; zero in plane strain.
  Eigen::RowVector3d thickness_strain;

  static PlaneStiffness isotropic(PlaneAssumption plane, const IsotropicConstants& constants);
  /// Unique axis normal to the plane (wood's cross-section).
  static PlaneStiffness axis_out_of_plane(PlaneAssumption plane,
                                          const TransverselyIsotropicConstants& constants);
  /// Unique axis in the plane, `angle` (rad) counter-clockwise from x.
  static PlaneStiffness axis_in_plane(PlaneAssumption plane,
                                      const TransverselyIsotropicConstants& constants,
                                      double angle);

  /// Largest eigenvalue over directions of the acoustic tensor, Pa.
  double wave_modulus() const;
};

}  // namespace mpm
