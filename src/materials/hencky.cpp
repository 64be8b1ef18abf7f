#include <mpm/core/lanes.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/plane_stress_return.hpp>

#include <cmath>

namespace mpm {

namespace {

/// Principal values and directions of a symmetric 2 x 2 tensor with positive eigenvalues.
struct Spectrum {
  Lanes first, second;  ///< eigenvalues, first >= second
  Lanes cosine, sine;   ///< of twice the angle of the first direction

  Spectrum(const Lanes& xx, const Lanes& yy, const Lanes& xy)
  {
    const Lanes mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
    // The smallest normal number: the direction does not matter where the eigenvalues coincide.
    const Lanes radius = stdx::sqrt(half * half + xy * xy) + 1e-300;
    first = mean + radius;
    second = (xx * yy - xy * xy) / first;
    cosine = half / radius;
    sine = xy / radius;
  }
};

/// xx, yy, xy of the tensor with these principal values in the directions of the spectrum.
struct PlaneTensor {
  Lanes xx, yy, xy;
  PlaneTensor(const Spectrum& s, const Lanes& first, const Lanes& second)
  {
    const Lanes mean = 0.5 * (first + second), half = 0.5 * (first - second);
    xx = mean + half * s.cosine;
    yy = mean - half * s.cosine;
    xy = half * s.sine;
  }
};

template <PlaneAssumption Plane, bool Plastic>
class Hencky final : public Law<2> {
  static constexpr bool plane_strain = Plane == PlaneAssumption::strain;
  // b_e,zz differs from 1 only by plastic flow; in plane stress it follows from tau_zz = 0.
  static constexpr bool carries_zz = plane_strain && Plastic;
  enum : int {
    volume = 0,
    be_xx,
    be_yy,
    be_xy,
    be_zz,
  };
  static constexpr int plastic_strain = carries_zz ? 5 : 4;
  static constexpr int plastic_work = plastic_strain + 1;
  static constexpr int columns = Plastic ? plastic_work + 1 : 4;

 public:
  Hencky(const IsotropicConstants& elastic, double density, const YieldConstants& yield)
      : elastic_(elastic),
        density_(density),
        yield_(yield),
        mu_(elastic.shear_modulus()),
        bulk_(elastic.bulk_modulus())
  {
  }

  std::vector<Column> state_columns() const override
  {
    std::vector<Column> list{{"initial_volume", 1, "m3"}, {"elastic_left_cauchy_green", 3, "1"}};
    if (carries_zz) list.push_back({"elastic_left_cauchy_green_zz", 1, "1"});
    if (Plastic) {
      list.push_back({"plastic_strain", 1, "1"});
      list.push_back({"plastic_work", 1, "J"});
    }
    return list;
  }

  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    state(be_xx, particle) = state(be_yy, particle) = 1;
    if (carries_zz) state(be_zz, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      double* s = state + k * columns * lane_count;
      const double* l = gradient + k * 4 * lane_count;
      // f = I + dt L, b_e = f b_e f^T
      const Lanes fxx = 1.0 + dt * load(l), fyx = dt * load(l + lane_count),
                  fxy = dt * load(l + 2 * lane_count), fyy = 1.0 + dt * load(l + 3 * lane_count);
      const Lanes bxx = at(s, be_xx), byy = at(s, be_yy), bxy = at(s, be_xy);
      const Lanes axx = fxx * bxx + fxy * bxy, axy = fxx * bxy + fxy * byy,
                  ayx = fyx * bxx + fyy * bxy, ayy = fyx * bxy + fyy * byy;
      const Lanes xx = axx * fxx + axy * fxy, xy = axx * fyx + axy * fyy,
                  yy = ayx * fyx + ayy * fyy;
      store(xx, s + be_xx * lane_count);
      store(yy, s + be_yy * lane_count);
      store(xy, s + be_xy * lane_count);
      stress_and_return(s, Spectrum(xx, yy, xy), force_stress + k * 3 * lane_count);
    }
  }

  void force_stress(const double* state, int blocks, double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      const double* s = state + k * columns * lane_count;
      const Spectrum spectrum(at(s, be_xx), at(s, be_yy), at(s, be_xy));
      const Strain e = elastic_strain(s, spectrum);
      const Lanes trace = e.first + e.second + e.zz;
      put_force_stress(s, spectrum, principal_stress(e.first, trace),
                       principal_stress(e.second, trace), force_stress + k * 3 * lane_count);
    }
  }

  void cauchy_stress(const double* s, double* stress) const override
  {
    const Spectrum spectrum(at(s, be_xx), at(s, be_yy), at(s, be_xy));
    const Strain e = elastic_strain(s, spectrum);
    const Lanes trace = e.first + e.second + e.zz;
    // Plastic flow keeps the volume: J = sqrt(det b_e) = exp(trace).
    const Lanes inverse_j = lane_exp(-trace);
    const PlaneTensor tau(spectrum, principal_stress(e.first, trace),
                          principal_stress(e.second, trace));
    store(tau.xx * inverse_j, stress);
    store(tau.yy * inverse_j, stress + lane_count);
    store(plane_strain ? principal_stress(e.zz, trace) * inverse_j : Lanes(0.0),
          stress + 2 * lane_count);
    store(tau.xy * inverse_j, stress + 3 * lane_count);
    store(Lanes(0.0), stress + 4 * lane_count);
    store(Lanes(0.0), stress + 5 * lane_count);
  }

  Lanes elastic_energy(const double* s) const override
  {
    const Strain e = elastic_strain(s, Spectrum(at(s, be_xx), at(s, be_yy), at(s, be_xy)));
    const Lanes trace = e.first + e.second + e.zz, third = trace / 3.0;
    const Lanes d1 = e.first - third, d2 = e.second - third, d3 = e.zz - third;
    return at(s, volume) * (0.5 * bulk_ * trace * trace + mu_ * (d1 * d1 + d2 * d2 + d3 * d3));
  }

  double wave_speed() const override
  {
    return std::sqrt(elastic_.in_plane_modulus(Plane) / density_);
  }

 private:
  struct Strain {
    Lanes first, second, zz;  ///< principal logarithmic elastic strains
  };

  static Lanes at(const double* s, int column) { return load(s + column * lane_count); }

  Lanes principal_stress(const Lanes& strain, const Lanes& trace) const
  {
    return (bulk_ - 2.0 / 3.0 * mu_) * trace + 2 * mu_ * strain;
  }

  Strain elastic_strain(const double* s, const Spectrum& spectrum) const
  {
    Strain e{0.5 * lane_log(spectrum.first), 0.5 * lane_log(spectrum.second), 0.0};
    if constexpr (!plane_strain)
      e.zz = -elastic_.poisson_ratio / (1 - elastic_.poisson_ratio) * (e.first + e.second);
    else if constexpr (carries_zz)
      e.zz = 0.5 * lane_log(at(s, be_zz));
    return e;
  }

  static void put_force_stress(const double* s, const Spectrum& spectrum, const Lanes& first,
                               const Lanes& second, double* out)
  {
    const Lanes v0 = at(s, volume);
    const PlaneTensor tau(spectrum, v0 * first, v0 * second);
    store(tau.xx, out);
    store(tau.yy, out + lane_count);
    store(tau.xy, out + 2 * lane_count);
  }

  void stress_and_return(double* s, const Spectrum& spectrum, double* out) const
  {
    Strain e = elastic_strain(s, spectrum);
    if constexpr (Plastic) {
      if constexpr (plane_strain)
        return_radially(s, spectrum, e);
      else
        return_in_plane_stress(s, spectrum, e);
    }
    const Lanes trace = e.first + e.second + e.zz;
    put_force_stress(s, spectrum, principal_stress(e.first, trace),
                     principal_stress(e.second, trace), out);
  }

  /// Radial return of the deviator of the logarithmic strain; the trace stays.
  void return_radially(double* s, const Spectrum& spectrum, Strain& e) const
  {
    const Lanes third = (e.first + e.second + e.zz) * (1.0 / 3.0);
    const Lanes d1 = e.first - third, d2 = e.second - third, d3 = e.zz - third;
    const Lanes squared = 1.5 * (d1 * d1 + d2 * d2 + d3 * d3);  // (q / 2 mu)^2
    const Lanes hardening = at(s, plastic_strain);
    const Lanes limit = (yield_.yield_stress + yield_.hardening_modulus * hardening) / (2 * mu_);
    const LaneMask yields = squared > limit * limit;
    if (!stdx::any_of(yields)) return;
    const Lanes q = stdx::sqrt(squared);
    Lanes multiplier = 0.0, scale = 1.0;
    stdx::where(yields, multiplier) = 2 * mu_ * (q - limit) / (3 * mu_ + yield_.hardening_modulus);
    stdx::where(yields, scale) = 1.0 - 1.5 * multiplier / q;
    e = {third + scale * d1, third + scale * d2, third + scale * d3};
    record_flow(s, multiplier);
    const PlaneTensor be(spectrum, lane_exp(2.0 * e.first), lane_exp(2.0 * e.second));
    put_where(yields, be, s);
    store(select(yields, lane_exp(2.0 * e.zz), at(s, be_zz)), s + be_zz * lane_count);
  }

  void return_in_plane_stress(double* s, const Spectrum& spectrum, Strain& e) const
  {
    const double nu = elastic_.poisson_ratio;
    const double sum_modulus = elastic_.youngs_modulus / (1 - nu);
    const Lanes sum = e.first + e.second, difference = e.first - e.second;
    const Lanes stress_difference = 2 * mu_ * difference;
    const PlaneStressReturn flow =
        return_to_yield_plane_stress(sum_modulus * sum, stress_difference * stress_difference,
                                     at(s, plastic_strain), elastic_, yield_);
    if (!flow.any) return;
    // Elastic strains are proportional to the stresses in sum and difference.
    const Lanes new_sum = flow.sum_scale * sum, new_difference = flow.difference_scale * difference;
    e = {0.5 * (new_sum + new_difference), 0.5 * (new_sum - new_difference),
         -nu / (1 - nu) * new_sum};
    record_flow(s, flow.plastic_strain);
    put_where(flow.plastic_strain > 0.0,
              PlaneTensor(spectrum, lane_exp(2.0 * e.first), lane_exp(2.0 * e.second)), s);
  }

  /// Lanes that do not flow keep their b_e to the last bit.
  static void put_where(const LaneMask& mask, const PlaneTensor& be, double* s)
  {
    store(select(mask, be.xx, at(s, be_xx)), s + be_xx * lane_count);
    store(select(mask, be.yy, at(s, be_yy)), s + be_yy * lane_count);
    store(select(mask, be.xy, at(s, be_xy)), s + be_xy * lane_count);
  }

  void record_flow(double* s, const Lanes& increment) const
  {
    const Lanes strain = at(s, plastic_strain) + increment;
    const Lanes stress = yield_.yield_stress + yield_.hardening_modulus * strain;
    store(strain, s + plastic_strain * lane_count);
    store(at(s, plastic_work) + at(s, volume) * stress * increment, s + plastic_work * lane_count);
  }

  IsotropicConstants elastic_;
  double density_;
  YieldConstants yield_;
  double mu_, bulk_;
};

template <PlaneAssumption Plane>
std::unique_ptr<Law<2>> make(const IsotropicConstants& elastic, double density,
                             const std::optional<YieldConstants>& yield)
{
  if (yield) return std::make_unique<Hencky<Plane, true>>(elastic, density, *yield);
  return std::make_unique<Hencky<Plane, false>>(elastic, density, YieldConstants{0, 0});
}

}  // namespace

std::unique_ptr<Law<2>> make_hencky(PlaneAssumption plane, const IsotropicConstants& elastic,
                                    double density, std::optional<YieldConstants> yield)
{
  return plane == PlaneAssumption::strain ? make<PlaneAssumption::strain>(elastic, density, yield)
                                          : make<PlaneAssumption::stress>(elastic, density, yield);
}

}  // namespace mpm
