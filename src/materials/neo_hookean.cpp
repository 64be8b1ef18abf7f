#include <mpm/materials/plane_left_cauchy_green.hpp>
#include <mpm/materials/space_tensor.hpp>

#include <cmath>

#include "elastic_parameters.hpp"

/// Compressible neo-Hookean rubber, tau = mu (b - I) + lambda ln J I (Bonet & Wood 2008, 6.4.3).

namespace mpm {

namespace {

/// Plane strain or plane stress, where b_zz follows from tau_zz = 0.
template <PlaneAssumption Plane>
class NeoHookeanPlane final : public Law<2> {
  enum : int { volume = 0, xx, yy, xy, columns };

 public:
  NeoHookeanPlane(const IsotropicConstants& elastic, double density)
      : elastic_(elastic),
        density_(density),
        mu_(elastic.shear_modulus()),
        lambda_(elastic.bulk_modulus() - 2.0 / 3.0 * mu_)
  {
  }

  std::vector<Column> state_columns() const override
  {
    return {{"initial_volume", 1, "m3"}, {"left_cauchy_green", 3, "1"}};
  }
  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    state(xx, particle) = state(yy, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      double* s = state + k * columns * lane_count;
      const InPlane b =
          pushed_forward({at(s, xx), at(s, yy), at(s, xy)}, gradient + k * 4 * lane_count, dt);
      store(b.xx, s + xx * lane_count);
      store(b.yy, s + yy * lane_count);
      store(b.xy, s + xy * lane_count);
      put_force_stress(s, force_stress + k * 3 * lane_count);
    }
  }
  void force_stress(const double* state, int blocks, double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k)
      put_force_stress(state + k * columns * lane_count, force_stress + k * 3 * lane_count);
  }
  void cauchy_stress(const double* s, double* stress) const override
  {
    const Thickness z(*this, s);
    const Lanes inverse_j = lane_exp(-z.log_j), pressure = lambda_ * z.log_j - mu_;
    store((pressure + mu_ * at(s, xx)) * inverse_j, stress);
    store((pressure + mu_ * at(s, yy)) * inverse_j, stress + lane_count);
    store((pressure + mu_ * z.b) * inverse_j, stress + 2 * lane_count);
    store(mu_ * at(s, xy) * inverse_j, stress + 3 * lane_count);
    store(Lanes(0.0), stress + 4 * lane_count);
    store(Lanes(0.0), stress + 5 * lane_count);
  }
  Lanes elastic_energy(const double* s) const override
  {
    const Thickness z(*this, s);
    const Lanes trace = at(s, xx) + at(s, yy) + z.b;
    return at(s, volume) *
           (0.5 * mu_ * (trace - 3.0) - mu_ * z.log_j + 0.5 * lambda_ * z.log_j * z.log_j);
  }

  Lanes volume_ratio(const double* s) const override { return lane_exp(Thickness(*this, s).log_j); }

  double wave_speed() const override
  {
    return std::sqrt(elastic_.in_plane_modulus(Plane) / density_);
  }
  BendingModuli<2> bending_moduli() const override
  {
    return {Vec<2>::Constant(elastic_.bending_modulus(Plane))};
  }
  /// Along the largest stretch: rho_0 c^2 = d tau / d ln(stretch) - tau, and that of a transverse
  /// wave, mu b_max, where it is the faster one. In plane stress the thickness gives way:
  /// d ln J / d ln(stretch) = 2 mu b_zz / (2 mu b_zz + lambda).
  Lanes fastest_wave_squared(const double* s) const override
  {
    const Thickness z(*this, s);
    const Lanes mean = 0.5 * (at(s, xx) + at(s, yy)), half = 0.5 * (at(s, xx) - at(s, yy));
    const Lanes largest = mean + stdx::sqrt(half * half + at(s, xy) * at(s, xy));
    Lanes share = 1.0;
    if constexpr (Plane == PlaneAssumption::stress)
      share = 2.0 * mu_ * z.b / (2.0 * mu_ * z.b + lambda_);
    return (stdx::max(lambda_ * (share - z.log_j) + mu_, Lanes(0.0)) + mu_ * largest) / density_;
  }

 private:
  static Lanes at(const double* s, int column) { return load(s + column * lane_count); }

  /// b_zz and ln J of a state.
  struct Thickness {
    Lanes b = 1.0, log_j;
    Thickness(const NeoHookeanPlane& law, const double* s)
    {
      const Lanes in_plane = 0.5 * lane_log(at(s, xx) * at(s, yy) - at(s, xy) * at(s, xy));
      log_j = in_plane;
      if constexpr (Plane == PlaneAssumption::stress) {
        // tau_zz = mu (b - 1) + lambda ln J = 0 by Newton's method in q = ln b: tau_zz is convex
        // and rises with q, so that from the second step on it comes down to the root.
        Lanes q = 0.0;
        for (int iteration = 0; iteration < 50; ++iteration) {
          log_j = in_plane + 0.5 * q;
          const Lanes residual = law.mu_ * (b - 1.0) + law.lambda_ * log_j;
          if (stdx::all_of(stdx::abs(residual) <= 1e-15 * law.mu_)) break;
          q -= residual / (law.mu_ * b + 0.5 * law.lambda_);
          b = lane_exp(q);
        }
      }
    }
  };

  void put_force_stress(const double* s, double* out) const
  {
    const Lanes v0 = at(s, volume);
    const Lanes pressure = lambda_ * Thickness(*this, s).log_j - mu_;
    store(v0 * (pressure + mu_ * at(s, xx)), out);
    store(v0 * (pressure + mu_ * at(s, yy)), out + lane_count);
    store(v0 * mu_ * at(s, xy), out + 2 * lane_count);
  }

  IsotropicConstants elastic_;
  double density_, mu_, lambda_;
};

class NeoHookeanSolid final : public Law<3> {
  enum : int { volume = 0, left_cauchy_green, columns = left_cauchy_green + 6 };

 public:
  NeoHookeanSolid(const IsotropicConstants& elastic, double density)
      : bending_(elastic),
        density_(density),
        mu_(elastic.shear_modulus()),
        lambda_(elastic.bulk_modulus() - 2.0 / 3.0 * mu_)
  {
  }

  std::vector<Column> state_columns() const override
  {
    return {{"initial_volume", 1, "m3"}, {"left_cauchy_green", 6, "1"}};
  }
  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    for (int d = 0; d < 3; ++d) state(left_cauchy_green + d, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      double* s = state + k * columns * lane_count;
      const double* l = gradient + k * 9 * lane_count;
      Tensor f = Tensor::identity();  // I + dt L
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f.a[i][j] += dt * load(l + (i + 3 * j) * lane_count);
      store_scaled(b_of(s).turned(f), 1.0, s + left_cauchy_green * lane_count);
      store_scaled(kirchhoff(s), load(s), force_stress + k * 6 * lane_count);
    }
  }
  void force_stress(const double* state, int blocks, double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      const double* s = state + k * columns * lane_count;
      store_scaled(kirchhoff(s), load(s), force_stress + k * 6 * lane_count);
    }
  }
  void cauchy_stress(const double* s, double* stress) const override
  {
    store_scaled(kirchhoff(s), lane_exp(-log_j(s)), stress);
  }
  Lanes elastic_energy(const double* s) const override
  {
    const Lanes log = log_j(s);
    return load(s) * (0.5 * mu_ * (b_of(s).trace() - 3.0) - mu_ * log + 0.5 * lambda_ * log * log);
  }

  Lanes volume_ratio(const double* s) const override { return stdx::sqrt(b_of(s).determinant()); }

  double wave_speed() const override { return std::sqrt((lambda_ + 2 * mu_) / density_); }
  BendingModuli<3> bending_moduli() const override { return bending_; }
  /// Along the largest stretch: rho_0 c^2 = lambda (1 - ln J) + mu (1 + b_max), or mu b_max of a
  /// transverse wave, b_max bounded by mean and deviator.
  Lanes fastest_wave_squared(const double* s) const override
  {
    const Symmetric b = b_of(s);
    const Lanes largest = b.mean() + stdx::sqrt(2.0 / 3.0 * b.deviator().squared());
    return (stdx::max(lambda_ * (1.0 - log_j(s)) + mu_, Lanes(0.0)) + mu_ * largest) / density_;
  }

 private:
  static Symmetric b_of(const double* s)
  {
    return load_symmetric(s + left_cauchy_green * lane_count);
  }
  static Lanes log_j(const double* s) { return 0.5 * lane_log(b_of(s).determinant()); }
  Symmetric kirchhoff(const double* s) const
  {
    const Symmetric b = b_of(s);
    const Lanes pressure = lambda_ * log_j(s) - mu_;
    return {pressure + mu_ * b.xx,
            pressure + mu_ * b.yy,
            pressure + mu_ * b.zz,
            mu_ * b.xy,
            mu_ * b.yz,
            mu_ * b.xz};
  }

  BendingModuli<3> bending_;
  double density_, mu_, lambda_;
};

}  // namespace

LawRow neo_hookean_law()
{
  // With less it has no answer where it is pressed to half and beyond: no thickness that is free of
  // stress, and in plane strain a pressure that falls.
  KindParameter poisson_ratio = poisson_ratio_parameter();
  poisson_ratio.bound = from_below(0, 0.5);
  return {
      .keyword = "neo_hookean",
      .help = "rubber-like elastic, for large strains",
      .parameters = {density_parameter(), youngs_modulus_parameter(), poisson_ratio},
      .in_plane = [](const ParameterValues& v, PlaneAssumption plane) -> std::unique_ptr<Law<2>> {
        const IsotropicConstants elastic = isotropic_constants(v);
        const double density = v.number("density");
        if (plane == PlaneAssumption::strain)
          return std::make_unique<NeoHookeanPlane<PlaneAssumption::strain>>(elastic, density);
        return std::make_unique<NeoHookeanPlane<PlaneAssumption::stress>>(elastic, density);
      },
      .in_space = [](const ParameterValues& v) -> std::unique_ptr<Law<3>> {
        return std::make_unique<NeoHookeanSolid>(isotropic_constants(v), v.number("density"));
      }};
}

}  // namespace mpm
