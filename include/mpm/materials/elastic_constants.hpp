#pragma once

namespace mpm {

/// What the plane of the model does to the third direction.
enum class PlaneAssumption { strain, stress };

/// Isotropic elastic constants, Pa.
struct IsotropicConstants {
  double youngs_modulus;
  double poisson_ratio;

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poisson_ratio)); }
  /// P-wave (confined) modulus lambda + 2 mu.
  double wave_modulus() const { return bulk_modulus() + 4.0 / 3.0 * shear_modulus(); }
  /// In-plane stiffness of the fastest wave: P-wave modulus or E / (1 - nu^2).
  double in_plane_modulus(PlaneAssumption plane) const
  {
    return plane == PlaneAssumption::strain ? wave_modulus()
                                            : youngs_modulus / (1 - poisson_ratio * poisson_ratio);
  }
  /// Of fibres whose cross-section is free to curve in the plane: E / (1 - nu^2) where the third
  /// direction holds them, or E.
  double bending_modulus(PlaneAssumption plane) const
  {
    return plane == PlaneAssumption::strain ? youngs_modulus / (1 - poisson_ratio * poisson_ratio)
                                            : youngs_modulus;
  }
};

/// Von Mises yield with linear hardening (0: perfectly plastic), Pa.
struct YieldConstants {
  double yield_stress;
  double hardening_modulus = 0;
};

}  // namespace mpm
