#include <mpm/core/lanes.hpp>
#include <mpm/materials/bent_flow.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/logarithmic_wave.hpp>
#include <mpm/materials/plane_left_cauchy_green.hpp>
#include <mpm/materials/plane_logarithm.hpp>
#include <mpm/materials/plane_stress_return.hpp>
#include <mpm/materials/von_mises_flow.hpp>

#include <cmath>

namespace mpm {

namespace {

template <PlaneAssumption Plane, bool Plastic>
class Hencky final : public Law<2> {
  static constexpr bool plane_strain = Plane == PlaneAssumption::strain;
  // e_zz differs from 0 only by plastic flow; in plane stress it follows from tau_zz = 0.
  static constexpr bool carries_zz = plane_strain && Plastic;
  enum : int {
    volume = 0,
    be_xx,
    be_yy,
    be_xy,
    log_zz,
  };
  static constexpr int plastic_strain = carries_zz ? 5 : 4;
  static constexpr int plastic_work = plastic_strain + 1;
  static constexpr int columns = Plastic ? plastic_work + 1 : 4;
  static constexpr FlowColumns flow_columns{volume, plastic_strain, plastic_work};

 public:
  Hencky(const IsotropicConstants& elastic, double density, const YieldConstants& yield)
      : elastic_(elastic),
        density_(density),
        yield_(yield),
        mu_(elastic.shear_modulus()),
        bulk_(elastic.bulk_modulus()),
        lambda_(bulk_ - 2.0 / 3.0 * mu_),
        flow_(RadialFlow::of_strain(mu_, yield)),
        bent_flow_(Plane, elastic, yield)
  {
  }

  std::vector<Column> state_columns() const override
  {
    std::vector<Column> list{{"initial_volume", 1, "m3"}, {"elastic_left_cauchy_green", 3, "1"}};
    if (carries_zz) list.push_back({"elastic_log_strain_zz", 1, "1"});
    if (Plastic) {
      list.push_back({"plastic_strain", 1, "1"});
      list.push_back({"plastic_work", 1, "J"});
    }
    return list;
  }

  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    state(be_xx, particle) = state(be_yy, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      double* s = state + k * columns * lane_count;
      Strain e = trial_strain(s, gradient + k * 4 * lane_count, dt);
      if constexpr (Plastic) return_to_yield(s, e);
      put_force_stress(s, e, force_stress + k * 3 * lane_count);
    }
  }

  BendingModuli<2> bending_moduli() const override
  {
    return {Vec<2>::Constant(elastic_.bending_modulus(Plane))};
  }
  void update_bent(double* state, int blocks, const double* gradient, double dt,
                   double* force_stress, double* bending) const override
  {
    if constexpr (!Plastic)
      Law<2>::update_bent(state, blocks, gradient, dt, force_stress, bending);
    else
      for (int k = 0; k < blocks; ++k) {
        double* s = state + k * columns * lane_count;
        Strain e = trial_strain(s, gradient + k * 4 * lane_count, dt);
        return_to_yield(s, e, bending + k * bending_columns<2> * lane_count);
        put_force_stress(s, e, force_stress + k * 3 * lane_count);
      }
  }

  void force_stress(const double* state, int blocks, double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      const double* s = state + k * columns * lane_count;
      put_force_stress(s, elastic_strain(s), force_stress + k * 3 * lane_count);
    }
  }

  void cauchy_stress(const double* s, double* stress) const override
  {
    const Strain e = elastic_strain(s);
    const Lanes trace = e.trace();
    // Plastic flow keeps the volume: J = sqrt(det b_e) = exp(trace).
    const Lanes inverse_j = lane_exp(-trace);
    const Stress tau(*this, e);
    store(tau.xx * inverse_j, stress);
    store(tau.yy * inverse_j, stress + lane_count);
    store(plane_strain ? (lambda_ * trace + 2 * mu_ * e.zz) * inverse_j : Lanes(0.0),
          stress + 2 * lane_count);
    store(tau.xy * inverse_j, stress + 3 * lane_count);
    store(Lanes(0.0), stress + 4 * lane_count);
    store(Lanes(0.0), stress + 5 * lane_count);
  }

  Lanes elastic_energy(const double* s) const override
  {
    const Strain e = elastic_strain(s);
    const Lanes trace = e.trace(), d = e.mean_deviator();
    return at(s, volume) *
           (0.5 * bulk_ * trace * trace + mu_ * (6.0 * d * d + 0.5 * e.plane.difference_squared));
  }

  /// Plastic flow keeps the volume: J = sqrt(det b_e).
  Lanes volume_ratio(const double* s) const override
  {
    const Lanes in_plane = stdx::sqrt(at(s, be_xx) * at(s, be_yy) - at(s, be_xy) * at(s, be_xy));
    if constexpr (carries_zz)
      return in_plane * lane_exp(at(s, log_zz));
    else if constexpr (plane_strain)
      return in_plane;
    else
      return in_plane * lane_exp(zz_over_sum() * lane_log(in_plane));
  }

  double wave_speed() const override
  {
    return std::sqrt(elastic_.in_plane_modulus(Plane) / density_);
  }

  Lanes fastest_wave_squared(const double* state) const override
  {
    return logarithmic_wave_squared(*this, density_, mu_, state);
  }

 private:
  struct Strain {
    PlaneStrain plane;
    Lanes zz;

    Lanes trace() const { return plane.sum + zz; }
    /// Mean of the two in-plane principal deviators; the third is -2 times that.
    Lanes mean_deviator() const { return 0.5 * plane.sum - trace() * (1.0 / 3.0); }
  };

  /// Kirchhoff stress tau, Pa.
  struct Stress {
    Lanes xx, yy, xy;
    Stress(const Hencky& law, const Strain& e)
    {
      const Lanes both = law.lambda_ * e.trace() + law.mu_ * e.plane.sum;
      const Lanes half = law.mu_ * e.plane.difference_xx;
      xx = both + half;
      yy = both - half;
      xy = law.mu_ * e.plane.difference_xy;
    }
  };

  static Lanes at(const double* s, int column) { return load(s + column * lane_count); }

  /// `zz`: where it is a state of its own.
  Strain complete(const PlaneStrain& plane, const Lanes& zz) const
  {
    if constexpr (carries_zz)
      return {plane, zz};
    else if constexpr (plane_strain)
      return {plane, 0.0};
    else
      return {plane, zz_over_sum() * plane.sum};
  }
  Strain complete(const double* s, const PlaneStrain& plane) const
  {
    return complete(plane, carries_zz ? at(s, log_zz) : Lanes(0.0));
  }

  Strain elastic_strain(const double* s) const
  {
    return complete(s, logarithmic_strain(at(s, be_xx), at(s, be_yy), at(s, be_xy)));
  }

  /// b_e = f b_e f^T, and its strain.
  Strain trial_strain(double* s, const double* gradient, double dt) const
  {
    const auto [xx, yy, xy] =
        pushed_forward({at(s, be_xx), at(s, be_yy), at(s, be_xy)}, gradient, dt);
    store(xx, s + be_xx * lane_count);
    store(yy, s + be_yy * lane_count);
    store(xy, s + be_xy * lane_count);
    return complete(s, logarithmic_strain(xx, yy, xy));
  }

  /// Plane stress: e_zz / (e1 + e2).
  double zz_over_sum() const { return -elastic_.poisson_ratio / (1 - elastic_.poisson_ratio); }

  void put_force_stress(const double* s, const Strain& e, double* out) const
  {
    const Lanes v0 = at(s, volume);
    const Stress tau(*this, e);
    store(v0 * tau.xx, out);
    store(v0 * tau.yy, out + lane_count);
    store(v0 * tau.xy, out + 2 * lane_count);
  }

  void return_to_yield(double* s, Strain& e) const
  {
    if constexpr (plane_strain)
      return_radially(s, e);
    else
      return_in_plane_stress(s, e);
  }

  /// `bending`: as in bending.hpp.
  void return_to_yield(double* s, Strain& e, double* bending) const
  {
    const FibreDirection fibres(bending);
    const double of_difference = std::sqrt(3.0) * mu_;
    const double of_mean =
        plane_strain ? 6 * mu_ : elastic_.youngs_modulus / (2 * (1 - elastic_.poisson_ratio));
    const auto& [sum, xx, xy, squared] = e.plane;
    BentStress t =
        bent_flow_.stress(of_mean * (plane_strain ? e.mean_deviator() : sum),
                          of_difference * (fibres.cosine * xx + fibres.sine * xy),
                          of_difference * (fibres.cosine * xy - fibres.sine * xx), bending);
    const BentStress before = t;
    const BentReturn flow = bent_flow_(t, at(s, plastic_strain));
    BentFlow::take(before, t, bending);
    if (!flow.any) return;
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
    const Lanes mean = t.mean / of_mean, along = t.along / of_difference,
                shear = t.shear / of_difference, third = e.trace() * (1.0 / 3.0);
    const Strain flowed = complete(
        {plane_strain ? 2.0 * (third + mean) : mean, fibres.cosine * along - fibres.sine * shear,
         fibres.sine * along + fibres.cosine * shear, along * along + shear * shear},
        third - 2.0 * mean);
    put_where(flow.yields, PlaneTensor(flowed.plane), s);
    if constexpr (carries_zz)
      store(select(flow.yields, flowed.zz, at(s, log_zz)), s + log_zz * lane_count);
    e = {{select(flow.yields, flowed.plane.sum, sum),
          select(flow.yields, flowed.plane.difference_xx, xx),
          select(flow.yields, flowed.plane.difference_xy, xy),
          select(flow.yields, flowed.plane.difference_squared, squared)},
         select(flow.yields, flowed.zz, e.zz)};
  }

  void return_radially(double* s, Strain& e) const
  {
    const Lanes squared = deviator_squared(e);
    const RadialReturn flow = flow_(squared, at(s, plastic_strain));
    if (!flow.any) return;
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
    scale_deviator(s, e, flow);
  }
  /// (q / 2 mu)^2
  static Lanes deviator_squared(const Strain& e)
  {
    const Lanes d = e.mean_deviator();
    return 9.0 * d * d + 0.75 * e.plane.difference_squared;
  }
  /// Of the logarithmic strain; the trace stays.
  static void scale_deviator(double* s, Strain& e, const RadialReturn& flow)
  {
    const Lanes third = e.trace() * (1.0 / 3.0), d = flow.scale * e.mean_deviator();
    scale_strain(e, 2.0 * (third + d), flow.scale);
    e.zz = third - 2.0 * d;
    put_where(flow.yields, PlaneTensor(e.plane), s);
    store(select(flow.yields, e.zz, at(s, log_zz)), s + log_zz * lane_count);
  }

  void return_in_plane_stress(double* s, Strain& e) const
  {
    const double sum_modulus = elastic_.youngs_modulus / (1 - elastic_.poisson_ratio);
    const Lanes sum = sum_modulus * e.plane.sum,
                difference_squared = 4 * mu_ * mu_ * e.plane.difference_squared;
    const PlaneStressReturn flow = return_to_yield_plane_stress(
        sum, difference_squared, at(s, plastic_strain), elastic_, yield_);
    if (!flow.any) return;
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
    // Elastic strains are proportional to the stresses in sum and difference.
    scale_strain(e, flow.sum_scale * e.plane.sum, flow.difference_scale);
    e.zz = zz_over_sum() * e.plane.sum;
    put_where(flow.plastic_strain > 0.0, PlaneTensor(e.plane), s);
  }

  static void scale_strain(Strain& e, const Lanes& sum, const Lanes& scale)
  {
    e.plane = {sum, scale * e.plane.difference_xx, scale * e.plane.difference_xy,
               scale * scale * e.plane.difference_squared};
  }

  /// Lanes that do not flow keep their b_e to the last bit.
  static void put_where(const LaneMask& mask, const PlaneTensor& be, double* s)
  {
    store(select(mask, be.xx, at(s, be_xx)), s + be_xx * lane_count);
    store(select(mask, be.yy, at(s, be_yy)), s + be_yy * lane_count);
    store(select(mask, be.xy, at(s, be_xy)), s + be_xy * lane_count);
  }

  IsotropicConstants elastic_;
  double density_;
  YieldConstants yield_;
  double mu_, bulk_, lambda_;
  RadialFlow flow_;
  BentFlow bent_flow_;
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
