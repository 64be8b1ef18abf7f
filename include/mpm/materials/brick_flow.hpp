#pragma once
/// Von Mises flow of bricks that bend: the deviator at the centre and the moments of the plates
/// across all axes yield together, and flow along the normal of the common surface,
///   Q = q^2 + s^2 / 2 + sqrt(s^4 / 4 + sum over the plates of <N, T>^2) <= s_Y^2,
/// that of shells (Ilyushin 1948, in the form of Ivanov 1967) as in bent_flow.hpp: T the stress of
/// the fibres of a plate, s^2 the sum of its squares and that of warping, N the deviator at the
/// centre, <N, T> = 3/2 N : T, of which q^2 = <N, N>. Rounded as there.

#include <mpm/materials/bent_flow.hpp>
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/space_tensor.hpp>
#include <mpm/materials/von_mises_flow.hpp>

#include <array>
#include <cmath>

namespace mpm {

/// R of F = R U, det F > 0, to 1e-4 for stretches from 1/3 to 3 (Newton's method: Higham 1986, SIAM
/// J. Sci. Stat. Comput. 7:1160).
inline Tensor rotation_in(const Tensor& f)
{
  Tensor r = f;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const Tensor inverse = r.inverse();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r.a[i][j] = 0.5 * (r.a[i][j] + inverse.a[j][i]);
  }
  return r;
}

/// Stresses of a brick, Pa.
struct BrickStress {
  Symmetric deviator;                              ///< at the centre
  std::array<Lanes, bending_stresses<3>> bending;  ///< as in bending.hpp
};

class BrickFlow {
 public:
  BrickFlow(const IsotropicConstants& elastic, const YieldConstants& yield)
      : shear_modulus_(3 * elastic.shear_modulus()), yield_(yield)
  {
    // Of energies per volume: E / (1 - nu) / 12 and 2 G / 12 times the squares of what outermost
    // fibres are strained by, E / 18 of what they are warped by.
    for (std::size_t k = 0; k < modulus_.size(); ++k)
      modulus_[k] = k >= 9       ? elastic.youngs_modulus * 16 / 9
                    : k % 3 == 0 ? elastic.youngs_modulus / (1 - elastic.poisson_ratio) * 2 / 3
                                 : 4 * elastic.shear_modulus();
  }

  /// From the trial stress to the yield surface. `deviator`: of the stress at the centre, Pa, along
  /// the axes of space; `columns`: as in bending.hpp; `plastic_strain`: before the step.
  BentReturn operator()(Symmetric& deviator, double* columns, const Lanes& plastic_strain) const
  {
    BrickStress t;
    Lanes fibres = 0.0;
    for (std::size_t k = 0; k < t.bending.size(); ++k) {
      t.bending[k] = load(columns + k * lane_count);
      fibres += t.bending[k] * t.bending[k];
    }
    const Lanes limit = yield_.yield_stress + yield_.hardening_modulus * plastic_strain;
    const Lanes centre = 1.5 * deviator.squared();
    // As if all of the stress at the centre were along the fibres.
    const Lanes most = centre + 0.5 * fibres + stdx::sqrt((0.25 * fibres + centre) * fibres);
    if (stdx::none_of(most > limit * limit)) {
      take_no_moments<3>(columns);
      return {};
    }
    const Tensor rotation = rotation_of(columns);
    t.deviator = deviator.turned(rotation.transposed());
    const BentReturn flow = returned(t, limit);
    if (!flow.any) {
      take_no_moments<3>(columns);
      return flow;
    }
    put_where(flow.yields, t.deviator.turned(rotation), deviator);
    for (std::size_t k = 0; k < t.bending.size(); ++k) {
      double* stress = columns + k * lane_count;
      store(load(stress) - t.bending[k], stress);
    }
    return flow;
  }

 private:
  static Tensor rotation_of(const double* columns)
  {
    Tensor f;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        f.a[i][j] = load(columns + (bending_stresses<3> + i + 3 * j) * lane_count);
    return rotation_in(f);
  }

  /// Of the deviator, along the parts of the stress of plate j's fibres: <N, T> is their product.
  static std::array<Lanes, 3> along(const Symmetric& n, int j)
  {
    const Lanes normal[3] = {n.xx, n.yy, n.zz}, shear[3] = {n.yz, n.xz, n.xy};
    return {-1.5 * normal[j], std::sqrt(0.75) * (normal[(j + 1) % 3] - normal[(j + 2) % 3]),
            std::sqrt(3.0) * shear[j]};
  }
  /// Adds the deviator of the stress of plate j's fibres, times a factor.
  static void add(const Lanes* part, int j, const Lanes& factor, Symmetric& sum)
  {
    Lanes* normal[3] = {&sum.xx, &sum.yy, &sum.zz};
    Lanes* shear[3] = {&sum.yz, &sum.xz, &sum.xy};
    const Lanes third = part[0] * (1.0 / 3), half = part[1] / std::sqrt(3.0);
    *normal[j] -= 2.0 * factor * third;
    *normal[(j + 1) % 3] += factor * (third + half);
    *normal[(j + 2) % 3] += factor * (third - half);
    *shear[j] += factor * part[2] / std::sqrt(3.0);
  }
  /// By cutting planes (Simo & Ortiz 1985, CMAME 49:221).
  BentReturn returned(BrickStress& t, const Lanes& limit) const
  {
    constexpr int most_iterations = 30;
    // Of the next to last step: the last one squares it, and no lane hangs on its neighbours.
    constexpr double tolerance = 1e-8;
    BentReturn result;
    const BrickStress trial = t;
    const Lanes rounded = rounded_vertex * limit * limit;
    Lanes multiplier = 0.0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      Lanes fibres = 0.0;
      for (const Lanes& part : t.bending) fibres += part * part;
      std::array<Lanes, 3> centre[3];
      Lanes product[3], products = 0.0;
      for (int j = 0; j < 3; ++j) {
        centre[j] = along(t.deviator, j);
        product[j] = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
          product[j] += centre[j][k] * t.bending[3 * std::size_t(j) + k];
        products += product[j] * product[j];
      }
      const Lanes half = 0.5 * fibres + rounded, root = stdx::sqrt(half * half + products);
      const Lanes squared = 1.5 * t.deviator.squared() + 0.5 * fibres + (root - rounded);
      if (iteration == 0) {
        result.yields = squared > limit * limit;
        result.any = stdx::any_of(result.yields);
        if (!result.any) return result;
      }
      const Lanes now = limit + yield_.hardening_modulus * multiplier;
      const Lanes stress = select(result.yields, stdx::sqrt(squared), now);
      const bool last = stdx::all_of(stress - now <= tolerance * now);
      const Lanes inverse = 1.0 / stress, half_root = 0.5 / root;
      Symmetric normal = inverse * t.deviator;
      std::array<Lanes, bending_stresses<3>> slope;
      for (std::size_t k = 0; k < slope.size(); ++k)
        slope[k] = (0.5 + half * half_root) * inverse * t.bending[k];
      for (int j = 0; j < 3; ++j) {
        const Lanes factor = product[j] * half_root * inverse;
        add(&t.bending[3 * std::size_t(j)], j, factor, normal);
        for (std::size_t k = 0; k < 3; ++k) slope[3 * std::size_t(j) + k] += factor * centre[j][k];
      }
      Lanes stiffness = yield_.hardening_modulus + shear_modulus_ * 1.5 * normal.squared();
      for (std::size_t k = 0; k < slope.size(); ++k) stiffness += modulus_[k] * slope[k] * slope[k];
      // Nothing but a brick without stress has so little.
      const Lanes step = (stress - now) / stdx::max(stiffness, Lanes(1e-6 * shear_modulus_));
      multiplier += step;
      t.deviator = t.deviator + (-shear_modulus_ * step) * normal;
      // A plane that cuts beyond where the moments are gone is of no use there.
      Lanes left = 0.0;
      for (std::size_t k = 0; k < slope.size(); ++k) {
        slope[k] = t.bending[k] - modulus_[k] * step * slope[k];
        left += slope[k] * t.bending[k];
      }
      for (std::size_t k = 0; k < slope.size(); ++k)
        t.bending[k] = select(left > 0.0, slope[k], Lanes(0.0));
      if (last) break;
    }
    const Symmetric lost = trial.deviator + Lanes(-1.0) * t.deviator;
    // Of what is left over the plastic strains.
    Lanes work = 1.5 / shear_modulus_ * t.deviator.contracted(lost);
    for (std::size_t k = 0; k < t.bending.size(); ++k)
      work += t.bending[k] * (trial.bending[k] - t.bending[k]) / modulus_[k];
    result.plastic_strain = work / (limit + yield_.hardening_modulus * multiplier);
    return result;
  }

  double shear_modulus_;
  std::array<double, bending_stresses<3>> modulus_;  ///< Pa, of the stresses of fibres
  YieldConstants yield_;
};

}  // namespace mpm
