#include <mpm/core/lanes.hpp>
#include <mpm/materials/bent_flow.hpp>
#include <mpm/materials/hypoelastic.hpp>
#include <mpm/materials/logarithmic_wave.hpp>
#include <mpm/materials/plane_stress_return.hpp>
#include <mpm/materials/von_mises_flow.hpp>

#include <Eigen/LU>
#include <cmath>

namespace mpm {

namespace {

/// Cosine and sine of the rotation R in F = R U: tan = (Fyx - Fxy) / (Fxx + Fyy).
struct Rotation {
  Lanes c, s;
  Rotation(const Lanes& fxx, const Lanes& fyx, const Lanes& fxy, const Lanes& fyy)
  {
    c = fxx + fyy;
    s = fyx - fxy;
    const Lanes inverse = 1.0 / stdx::sqrt(c * c + s * s);
    c *= inverse;
    s *= inverse;
  }
};

/// xx, yy, xy components of a symmetric tensor.
struct Symmetric {
  Lanes xx, yy, xy;

  /// R A R^T
  Symmetric turned(const Rotation& r) const
  {
    const Lanes cc = r.c * r.c, ss = r.s * r.s, cs = r.c * r.s;
    return {cc * xx + ss * yy - 2.0 * cs * xy, ss * xx + cc * yy + 2.0 * cs * xy,
            cs * (xx - yy) + (cc - ss) * xy};
  }
  /// R^T A R
  Symmetric turned_back(Rotation r) const
  {
    r.s = -r.s;
    return turned(r);
  }
};

template <PlaneAssumption Plane, bool Plastic>
class Hypoelastic final : public Law<2> {
  static constexpr bool plane_strain = Plane == PlaneAssumption::strain;
  enum : int { volume = 0, f_xx, f_yx, f_xy, f_yy, t_xx, t_yy, t_xy, third };
  // `third`: tau_zz in plane strain, logarithmic thickness strain in plane stress.
  static constexpr int plastic_strain = third + 1;
  static constexpr int plastic_work = plastic_strain + 1;
  static constexpr int columns = Plastic ? plastic_work + 1 : third + 1;
  static constexpr FlowColumns flow_columns{volume, plastic_strain, plastic_work};

 public:
  Hypoelastic(const PlaneStiffness& stiffness, const IsotropicConstants& elastic,
              const YieldConstants& yield, double density)
      : stiffness_(stiffness),
        compliance_(stiffness.in_plane.inverse()),
        elastic_(elastic),
        yield_(yield),
        density_(density),
        wave_speed_(std::sqrt(stiffness.wave_modulus() / density)),
        flow_(RadialFlow::of_stress(elastic.shear_modulus(), yield)),
        bent_flow_(Plane, elastic, yield)
  {
  }

  std::vector<Column> state_columns() const override
  {
    std::vector<Column> list{{"initial_volume", 1, "m3"},
                             {"deformation_gradient", 4, "1"},
                             {"turning_kirchhoff_stress", 3, "Pa"}};
    list.push_back(plane_strain ? Column{"turning_kirchhoff_stress_zz", 1, "Pa"}
                                : Column{"thickness_strain", 1, "1"});
    if (Plastic) {
      list.push_back({"plastic_strain", 1, "1"});
      list.push_back({"plastic_work", 1, "J"});
    }
    return list;
  }

  void initialise(ColumnGroup& state, LocalIndex particle) const override
  {
    state(f_xx, particle) = state(f_yy, particle) = 1;
  }

  void update(double* state, int blocks, const double* gradient, double dt,
              double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k)
      update_block(state + k * columns * lane_count, gradient + k * 4 * lane_count, dt,
                   force_stress + k * 3 * lane_count);
  }

  BendingModuli<2> bending_moduli() const override
  {
    return {{1 / compliance_(0, 0), 1 / compliance_(1, 1)}};
  }
  void update_bent(double* state, int blocks, const double* gradient, double dt,
                   double* force_stress, double* bending) const override
  {
    if constexpr (!Plastic)
      Law<2>::update_bent(state, blocks, gradient, dt, force_stress, bending);
    else
      for (int k = 0; k < blocks; ++k)
        update_block(state + k * columns * lane_count, gradient + k * 4 * lane_count, dt,
                     force_stress + k * 3 * lane_count,
                     bending + k * bending_columns<2> * lane_count);
  }

  void force_stress(const double* state, int blocks, double* force_stress) const override
  {
    for (int k = 0; k < blocks; ++k) {
      const double* s = state + k * columns * lane_count;
      put_force_stress(s, rotation(s), stress(s), force_stress + k * 3 * lane_count);
    }
  }

  void cauchy_stress(const double* s, double* out) const override
  {
    const Lanes inverse_j = 1.0 / volume_ratio(s);
    const Symmetric tau = stress(s).turned(rotation(s));
    store(tau.xx * inverse_j, out);
    store(tau.yy * inverse_j, out + lane_count);
    store(plane_strain ? at(s, third) * inverse_j : Lanes(0.0), out + 2 * lane_count);
    store(tau.xy * inverse_j, out + 3 * lane_count);
    store(Lanes(0.0), out + 4 * lane_count);
    store(Lanes(0.0), out + 5 * lane_count);
  }

  Lanes elastic_energy(const double* s) const override
  {
    const Symmetric t = stress(s);
    if constexpr (Plastic && plane_strain) {
      const Lanes zz = at(s, third), p = (t.xx + t.yy + zz) / 3.0;
      const Lanes a = t.xx - p, b = t.yy - p, c = zz - p;
      return at(s, volume) *
             (p * p / (2 * elastic_.bulk_modulus()) +
              (a * a + b * b + c * c + 2.0 * t.xy * t.xy) / (4 * elastic_.shear_modulus()));
    }
    const Eigen::Matrix3d& m = compliance_;
    const Lanes exx = m(0, 0) * t.xx + m(0, 1) * t.yy + m(0, 2) * t.xy;
    const Lanes eyy = m(1, 0) * t.xx + m(1, 1) * t.yy + m(1, 2) * t.xy;
    const Lanes gxy = m(2, 0) * t.xx + m(2, 1) * t.yy + m(2, 2) * t.xy;
    return 0.5 * at(s, volume) * (t.xx * exx + t.yy * eyy + t.xy * gxy);
  }

  Lanes volume_ratio(const double* s) const override
  {
    const Lanes in_plane = at(s, f_xx) * at(s, f_yy) - at(s, f_xy) * at(s, f_yx);
    return plane_strain ? in_plane : in_plane * lane_exp(at(s, third));
  }

  double wave_speed() const override { return wave_speed_; }

  Lanes fastest_wave_squared(const double* state) const override
  {
    return logarithmic_wave_squared(*this, density_, stiffness_.in_plane(2, 2), state);
  }

 private:
  static Lanes at(const double* s, int column) { return load(s + column * lane_count); }
  static void put(const Lanes& value, double* s, int column)
  {
    store(value, s + column * lane_count);
  }
  static Symmetric stress(const double* s) { return {at(s, t_xx), at(s, t_yy), at(s, t_xy)}; }
  static Rotation rotation(const double* s)
  {
    return {at(s, f_xx), at(s, f_yx), at(s, f_xy), at(s, f_yy)};
  }

  static void put_force_stress(const double* s, const Rotation& r, const Symmetric& t, double* out)
  {
    const Lanes v0 = at(s, volume);
    const Symmetric tau = t.turned(r);
    store(v0 * tau.xx, out);
    store(v0 * tau.yy, out + lane_count);
    store(v0 * tau.xy, out + 2 * lane_count);
  }

  template <class... Bent>
  void update_block(double* s, const double* l, double dt, double* out, Bent... bending) const
  {
    // dt L, and the midpoint gradient dt L (I + dt L / 2)^-1.
    const Lanes axx = dt * load(l), ayx = dt * load(l + lane_count),
                axy = dt * load(l + 2 * lane_count), ayy = dt * load(l + 3 * lane_count);
    const Lanes mxx = 1.0 + 0.5 * axx, myy = 1.0 + 0.5 * ayy, mxy = 0.5 * axy, myx = 0.5 * ayx;
    const Lanes inverse = 1.0 / (mxx * myy - mxy * myx);
    const Lanes gxx = (axx * myy - axy * myx) * inverse, gxy = (axy * mxx - axx * mxy) * inverse,
                gyx = (ayx * myy - ayy * myx) * inverse, gyy = (ayy * mxx - ayx * mxy) * inverse;

    const Lanes oxx = at(s, f_xx), oyx = at(s, f_yx), oxy = at(s, f_xy), oyy = at(s, f_yy);
    const Lanes nxx = oxx + axx * oxx + axy * oyx, nyx = oyx + ayx * oxx + ayy * oyx,
                nxy = oxy + axx * oxy + axy * oyy, nyy = oyy + ayx * oxy + ayy * oyy;
    put(nxx, s, f_xx);
    put(nyx, s, f_yx);
    put(nxy, s, f_xy);
    put(nyy, s, f_yy);

    const Rotation middle(oxx + nxx, oyx + nyx, oxy + nxy, oyy + nyy);
    const Symmetric d = Symmetric{gxx, gyy, 0.5 * (gxy + gyx)}.turned_back(middle);
    const Lanes shear = 2.0 * d.xy;
    const Eigen::Matrix3d& c = stiffness_.in_plane;
    Symmetric t = stress(s);
    const Symmetric step{c(0, 0) * d.xx + c(0, 1) * d.yy + c(0, 2) * shear,
                         c(1, 0) * d.xx + c(1, 1) * d.yy + c(1, 2) * shear,
                         c(2, 0) * d.xx + c(2, 1) * d.yy + c(2, 2) * shear};
    t = {t.xx + step.xx, t.yy + step.yy, t.xy + step.xy};
    if constexpr (plane_strain) {
      const auto& z = stiffness_.out_of_plane;
      Lanes zz = at(s, third) + z(0) * d.xx + z(1) * d.yy + z(2) * shear;
      if constexpr (Plastic) return_to_yield(s, t, zz, bending...);
      put(zz, s, third);
    } else {
      const auto& z = stiffness_.thickness_strain;
      const Symmetric old = stress(s);
      const Lanes trial = t.xx + t.yy;
      Lanes zz = 0.0;
      if constexpr (Plastic) return_to_yield(s, t, zz, bending...);
      // Elastic part from the stress that was really gained, plastic part -(dep_xx + dep_yy).
      const double compliance = (1 - elastic_.poisson_ratio) / elastic_.youngs_modulus;
      put(at(s, third) + z(0) * (t.xx - old.xx) + z(1) * (t.yy - old.yy) + z(2) * (t.xy - old.xy) -
              compliance * (trial - (t.xx + t.yy)),
          s, third);
    }
    put(t.xx, s, t_xx);
    put(t.yy, s, t_yy);
    put(t.xy, s, t_xy);
    put_force_stress(s, Rotation(nxx, nyx, nxy, nyy), t, out);
  }

  void return_to_yield(double* s, Symmetric& t, Lanes& zz) const
  {
    if constexpr (plane_strain)
      return_radially(s, t, zz);
    else
      return_in_plane_stress(s, t);
  }
  void return_radially(double* s, Symmetric& t, Lanes& zz) const
  {
    const Lanes p = (t.xx + t.yy + zz) / 3.0;
    const Lanes a = t.xx - p, b = t.yy - p, c = zz - p;
    const Lanes squared = 1.5 * (a * a + b * b + c * c + 2.0 * t.xy * t.xy);
    const RadialReturn flow = flow_(squared, at(s, plastic_strain));
    if (!flow.any) return;
    const Lanes& scale = flow.scale;
    t = {p + scale * a, p + scale * b, scale * t.xy};
    zz = p + scale * c;
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
  }

  void return_in_plane_stress(double* s, Symmetric& t) const
  {
    const Lanes sum = t.xx + t.yy, difference = t.xx - t.yy;
    const PlaneStressReturn flow = return_to_yield_plane_stress(
        sum, difference * difference + 4.0 * t.xy * t.xy, at(s, plastic_strain), elastic_, yield_);
    if (!flow.any) return;
    const Lanes new_sum = flow.sum_scale * sum, new_difference = flow.difference_scale * difference;
    t = {0.5 * (new_sum + new_difference), 0.5 * (new_sum - new_difference),
         flow.difference_scale * t.xy};
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
  }

  /// Fibres lie along the axes of the frame that turns with the cell. `bending`: as in bending.hpp.
  void return_to_yield(double* s, Symmetric& t, Lanes& zz, double* bending) const
  {
    const Lanes p = plane_strain ? (t.xx + t.yy + zz) / 3.0 : Lanes(0.0);
    const double of_mean = plane_strain ? 3 : 1, of_difference = std::sqrt(0.75),
                 of_shear = std::sqrt(3.0);
    BentStress stress = bent_flow_.stress(of_mean * (0.5 * (t.xx + t.yy) - p),
                                          of_difference * (t.xx - t.yy), of_shear * t.xy, bending);
    const BentStress before = stress;
    const BentReturn flow = bent_flow_(stress, at(s, plastic_strain));
    BentFlow::take(before, stress, bending);
    if (!flow.any) return;
    record_flow(s, flow_columns, yield_, flow.plastic_strain);
    const Lanes mean = stress.mean / of_mean, half = stress.along / (2 * of_difference);
    t = {select(flow.yields, p + mean + half, t.xx), select(flow.yields, p + mean - half, t.yy),
         select(flow.yields, stress.shear / of_shear, t.xy)};
    zz = select(flow.yields, p - 2.0 * mean, zz);
  }

  PlaneStiffness stiffness_;
  Eigen::Matrix3d compliance_;
  IsotropicConstants elastic_;
  YieldConstants yield_;
  double density_;
  double wave_speed_;  ///< m/s; of a search over all directions, and asked for at every block
  RadialFlow flow_;
  BentFlow bent_flow_;
};

}  // namespace

std::unique_ptr<Law<2>> make_hypoelastic(PlaneAssumption plane, const PlaneStiffness& stiffness,
                                         double density)
{
  const IsotropicConstants none{1, 0};
  if (plane == PlaneAssumption::strain)
    return std::make_unique<Hypoelastic<PlaneAssumption::strain, false>>(
        stiffness, none, YieldConstants{0}, density);
  return std::make_unique<Hypoelastic<PlaneAssumption::stress, false>>(stiffness, none,
                                                                       YieldConstants{0}, density);
}

std::unique_ptr<Law<2>> make_hypoelastic_von_mises(PlaneAssumption plane,
                                                   const IsotropicConstants& elastic,
                                                   const YieldConstants& yield, double density)
{
  const PlaneStiffness stiffness = PlaneStiffness::isotropic(plane, elastic);
  if (plane == PlaneAssumption::strain)
    return std::make_unique<Hypoelastic<PlaneAssumption::strain, true>>(stiffness, elastic, yield,
                                                                        density);
  return std::make_unique<Hypoelastic<PlaneAssumption::stress, true>>(stiffness, elastic, yield,
                                                                      density);
}

}  // namespace mpm
