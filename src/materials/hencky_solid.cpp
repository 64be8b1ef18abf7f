#include <mpm/materials/brick_flow.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/logarithmic_wave.hpp>
#include <mpm/materials/space_logarithm.hpp>
#include <mpm/materials/von_mises_flow.hpp>

#include <cmath>

namespace mpm {

namespace {

template <bool Plastic>
class HenckySolid final : public Law<3> {
  enum : int { volume = 0, be, plastic_strain = be + 6, plastic_work };
  static constexpr int columns = Plastic ? plastic_work + 1 : plastic_strain;
  static constexpr FlowColumns flow_columns{volume, plastic_strain, plastic_work};

 public:
  HenckySolid(const IsotropicConstants& elastic, double density, const YieldConstants& yield)
      : bending_(elastic),
        density_(density),
        yield_(yield),
        mu_(elastic.shear_modulus()),
        bulk_(elastic.bulk_modulus()),
        wave_speed_(std::sqrt(elastic.wave_modulus() / density)),
        flow_(RadialFlow::of_strain(mu_, yield)),
        bent_flow_(elastic, yield)
  {
  }

  std::vector<Column> state_columns() const override
  {
    std::vector<Column> list{{"initial_volume", 1, "m3"}, {"elastic_left_cauchy_green", 6, "1"}};
    if (Plastic) {
      list.push_back({"plastic_strain", 1, "1"});
      list.push_back({"plastic_work", 1, "J"});
    }
    return list;
  }

  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    for (int d = 0; d < 3; ++d) state(be + d, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k)
      update_block(state + k * columns * lane_count, gradient + k * 9 * lane_count, dt,
                   force_stress + k * 6 * lane_count);
  }

  BendingModuli<3> bending_moduli() const override { return bending_; }
  void update_bent(double* state, int blocks, const double* gradient, double dt,
                   double* force_stress, double* bending) const override
  {
    if constexpr (!Plastic)
      Law<3>::update_bent(state, blocks, gradient, dt, force_stress, bending);
    else
      for (int k = 0; k < blocks; ++k)
        update_block(state + k * columns * lane_count, gradient + k * 9 * lane_count, dt,
                     force_stress + k * 6 * lane_count,
                     bending + k * bending_columns<3> * lane_count);
  }

  void force_stress(const double* state, int blocks, double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      const double* s = state + k * columns * lane_count;
      store_scaled(kirchhoff(elastic_strain(s)), at(s, volume), force_stress + k * 6 * lane_count);
    }
  }

  void cauchy_stress(const double* s, double* stress) const override
  {
    const LogarithmicStrain e = elastic_strain(s);
    // Plastic flow keeps the volume: J = sqrt(det b_e) = exp(trace).
    store_scaled(kirchhoff(e), lane_exp(-e.trace), stress);
  }

  Lanes elastic_energy(const double* s) const override
  {
    const LogarithmicStrain e = elastic_strain(s);
    return at(s, volume) * (0.5 * bulk_ * e.trace * e.trace + mu_ * e.deviator.squared());
  }

  /// Plastic flow keeps the volume: J = sqrt(det b_e).
  Lanes volume_ratio(const double* s) const override
  {
    return stdx::sqrt(elastic_left_cauchy_green(s).determinant());
  }

  double wave_speed() const override { return wave_speed_; }

  Lanes fastest_wave_squared(const double* state) const override
  {
    return logarithmic_wave_squared(*this, density_, mu_, state);
  }

 private:
  static Lanes at(const double* s, int column) { return load(s + column * lane_count); }
  static Symmetric elastic_left_cauchy_green(const double* s)
  {
    return load_symmetric(s + be * lane_count);
  }
  static LogarithmicStrain elastic_strain(const double* s)
  {
    return LogarithmicStrain(elastic_left_cauchy_green(s));
  }

  Symmetric kirchhoff(const LogarithmicStrain& e) const
  {
    const Lanes pressure = bulk_ * e.trace;
    const double two_mu = 2 * mu_;
    const Symmetric& d = e.deviator;
    return {pressure + two_mu * d.xx,
            pressure + two_mu * d.yy,
            pressure + two_mu * d.zz,
            two_mu * d.xy,
            two_mu * d.yz,
            two_mu * d.xz};
  }

  template <class... Bent>
  void update_block(double* s, const double* l, double dt, double* out, Bent... bending) const
  {
    Tensor f;  // I + dt L; b_e = f b_e f^T
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        f.a[i][j] = double(i == j) + dt * load(l + (i + 3 * j) * lane_count);
    Symmetric b = elastic_left_cauchy_green(s).turned(f);
    LogarithmicStrain e(b);
    if constexpr (Plastic) return_to_yield(s, e, b, bending...);
    store_scaled(b, 1.0, s + be * lane_count);
    store_scaled(kirchhoff(e), at(s, volume), out);
  }

  void return_to_yield(double* s, LogarithmicStrain& e, Symmetric& b) const
  {
    const RadialReturn flow = flow_(squared(e), at(s, plastic_strain));
    if (!flow.any) return;
    put_deviator(flow.yields, flow.scale * e.deviator, e, b);
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
  }
  /// `bending`: as in bending.hpp.
  void return_to_yield(double* s, LogarithmicStrain& e, Symmetric& b, double* bending) const
  {
    Symmetric deviator = Lanes(2 * mu_) * e.deviator;
    const BentReturn flow = bent_flow_(deviator, bending, at(s, plastic_strain));
    if (!flow.any) return;
    put_deviator(flow.yields, Lanes(1 / (2 * mu_)) * deviator, e, b);
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
  }
  /// (q / 2 mu)^2
  static Lanes squared(const LogarithmicStrain& e) { return 1.5 * e.deviator.squared(); }
  /// Of the logarithmic strain; the trace stays. Lanes that do not flow keep their b_e to the last
  /// bit.
  static void put_deviator(const LaneMask& yields, const Symmetric& deviator, LogarithmicStrain& e,
                           Symmetric& b)
  {
    e.deviator = deviator;
    put_where(yields, exponential_of_deviator(Lanes(2.0) * deviator, lane_exp(2.0 / 3.0 * e.trace)),
              b);
  }

  BendingModuli<3> bending_;
  double density_;
  YieldConstants yield_;
  double mu_, bulk_, wave_speed_;
  RadialFlow flow_;
  BrickFlow bent_flow_;
};

}  // namespace

std::unique_ptr<Law<3>> make_hencky_solid(const IsotropicConstants& elastic, double density,
                                          std::optional<YieldConstants> yield)
{
  if (yield) return std::make_unique<HenckySolid<true>>(elastic, density, *yield);
  return std::make_unique<HenckySolid<false>>(elastic, density, YieldConstants{0});
}

}  // namespace mpm
