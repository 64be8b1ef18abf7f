#include <mpm/core/lanes.hpp>
#include <mpm/materials/brick_flow.hpp>
#include <mpm/materials/hypoelastic_solid.hpp>
#include <mpm/materials/logarithmic_wave.hpp>
#include <mpm/materials/space_tensor.hpp>
#include <mpm/materials/von_mises_flow.hpp>

#include <cmath>

namespace mpm {

namespace {

/// Rotation of a step with midpoint gradient G: (I - W/2)^-1 (I + W/2), W the skew part of G. With
/// the axial vector b of W/2 this is I + 2 (B + B B) / (1 + b.b), B = W/2; |b| = tan(angle / 2).
Tensor rotation_of(const Tensor& g)
{
  const Lanes b[3] = {0.25 * (g.a[2][1] - g.a[1][2]), 0.25 * (g.a[0][2] - g.a[2][0]),
                      0.25 * (g.a[1][0] - g.a[0][1])};
  const Lanes squared = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
  const Lanes scale = 2.0 / (1.0 + squared);
  Tensor q;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    q.a[i][i] = 1.0 + scale * (b[i] * b[i] - squared);
    q.a[i][j] = scale * (b[i] * b[j] - b[k]);
    q.a[j][i] = scale * (b[i] * b[j] + b[k]);
  }
  return q;
}

template <bool Plastic>
class HypoelasticSolid final : public Law<3> {
  enum : int { volume = 0, volume_ratio_column, tau, plastic_strain = tau + 6, plastic_work };
  static constexpr int columns = Plastic ? plastic_work + 1 : plastic_strain;
  static constexpr FlowColumns flow_columns{volume, plastic_strain, plastic_work};

 public:
  HypoelasticSolid(const IsotropicConstants& elastic, const YieldConstants& yield, double density)
      : elastic_(elastic),
        yield_(yield),
        density_(density),
        flow_(RadialFlow::of_stress(elastic.shear_modulus(), yield)),
        bent_flow_(elastic, yield)
  {
  }

  std::vector<Column> state_columns() const override
  {
    std::vector<Column> list{
        {"initial_volume", 1, "m3"}, {"volume_ratio", 1, "1"}, {"kirchhoff_stress", 6, "Pa"}};
    if (Plastic) {
      list.push_back({"plastic_strain", 1, "1"});
      list.push_back({"plastic_work", 1, "J"});
    }
    return list;
  }

  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    state(volume_ratio_column, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k)
      update_block(state + k * columns * lane_count, gradient + k * 9 * lane_count, dt,
                   force_stress + k * 6 * lane_count);
  }

  BendingModuli<3> bending_moduli() const override { return BendingModuli<3>(elastic_); }
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
      store_scaled(stress(s), at(s, volume), force_stress + k * 6 * lane_count);
    }
  }

  void cauchy_stress(const double* s, double* out) const override
  {
    store_scaled(stress(s), 1.0 / at(s, volume_ratio_column), out);
  }

  Lanes elastic_energy(const double* s) const override
  {
    const Symmetric t = stress(s);
    const Lanes p = t.mean();
    return at(s, volume) * (p * p / (2 * elastic_.bulk_modulus()) +
                            t.deviator().squared() / (4 * elastic_.shear_modulus()));
  }

  Lanes volume_ratio(const double* s) const override { return at(s, volume_ratio_column); }

  double wave_speed() const override { return std::sqrt(elastic_.wave_modulus() / density_); }

  Lanes fastest_wave_squared(const double* state) const override
  {
    return logarithmic_wave_squared(*this, density_, elastic_.shear_modulus(), state);
  }

 private:
  static Lanes at(const double* s, int column) { return load(s + column * lane_count); }
  static Symmetric stress(const double* s) { return load_symmetric(s + tau * lane_count); }

  template <class... Bent>
  void update_block(double* s, const double* l, double dt, double* out, Bent... bending) const
  {
    // dt L, and the midpoint gradient G = dt L (I + dt L / 2)^-1.
    Tensor a, middle = Tensor::identity(), whole = Tensor::identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        a.a[i][j] = dt * load(l + (i + 3 * j) * lane_count);
        middle.a[i][j] += 0.5 * a.a[i][j];
        whole.a[i][j] += a.a[i][j];
      }
    const Tensor g = a * middle.inverse();
    store(volume_ratio(s) * whole.determinant(), s + volume_ratio_column * lane_count);

    // The increment belongs to the axes of the midpoint: half of it turns with the old stress, half
    // does not, which is right to second order and costs no second rotation.
    const Symmetric half = half_increment(g);
    Symmetric t = (stress(s) + half).turned(rotation_of(g)) + half;
    if constexpr (Plastic) return_to_yield(s, t, bending...);
    store_scaled(t, 1.0, s + tau * lane_count);
    store_scaled(t, at(s, volume), out);
  }

  /// C : sym(G) / 2
  Symmetric half_increment(const Tensor& g) const
  {
    const double mu = elastic_.shear_modulus(), lambda = elastic_.bulk_modulus() - 2.0 / 3.0 * mu;
    const Lanes dilation = 0.5 * lambda * (g.a[0][0] + g.a[1][1] + g.a[2][2]);
    return {dilation + mu * g.a[0][0],          dilation + mu * g.a[1][1],
            dilation + mu * g.a[2][2],          0.5 * mu * (g.a[0][1] + g.a[1][0]),
            0.5 * mu * (g.a[1][2] + g.a[2][1]), 0.5 * mu * (g.a[0][2] + g.a[2][0])};
  }

  void return_to_yield(double* s, Symmetric& t) const
  {
    const Symmetric dev = t.deviator();
    const RadialReturn flow = flow_(1.5 * dev.squared(), at(s, plastic_strain));
    if (!flow.any) return;
    put_deviator(flow.scale * dev, t);
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
  }
  /// `bending`: as in bending.hpp.
  void return_to_yield(double* s, Symmetric& t, double* bending) const
  {
    Symmetric deviator = t.deviator();
    const BentReturn flow = bent_flow_(deviator, bending, at(s, plastic_strain));
    if (!flow.any) return;
    put_deviator(deviator, t);
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
  }
  static void put_deviator(const Symmetric& deviator, Symmetric& t)
  {
    const Lanes p = t.mean();
    t = {p + deviator.xx, p + deviator.yy, p + deviator.zz, deviator.xy, deviator.yz, deviator.xz};
  }

  IsotropicConstants elastic_;
  YieldConstants yield_;
  double density_;
  RadialFlow flow_;
  BrickFlow bent_flow_;
};

}  // namespace

std::unique_ptr<Law<3>> make_hypoelastic_solid(const IsotropicConstants& elastic, double density,
                                               std::optional<YieldConstants> yield)
{
  if (yield) return std::make_unique<HypoelasticSolid<true>>(elastic, *yield, density);
  return std::make_unique<HypoelasticSolid<false>>(elastic, YieldConstants{0}, density);
}

}  // namespace mpm
