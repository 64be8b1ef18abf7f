#pragma once
/// Von Mises flow of bricks that bend: the deviator at the centre and the moments of the plates
/// across all axes yield together, and flow along the normal of the common surface,
///   Q = q^2 + s^2 / 2 + sqrt(s^4 / 4 + sum over the plates of <N, T>^2) <= s_Y^2,
/// that of shells (Ilyushin 1948, in the form of Ivanov 1967) as in bent_flow.hpp: T the stress of
/// the fibres of a plate, s^2 the sum of its squares and that of warping, N the deviator at the
/// centre, <N, T> = 3/2 N : T, of which q^2 = <N, N>. Rounded as there.

#include <mpm/materials/bending.hpp>
#include <mpm/materials/cutting_planes.hpp>
#include <mpm/materials/elastic_constants.hpp>
#include <mpm/materials/space_tensor.hpp>

#include <array>
#include <cmath>

namespace mpm {

/// R of F = R U, det F > 0, to rounding for stretches from 1/12 to 12 (Newton's method: Higham
/// 1986, SIAM J. Sci. Stat. Comput. 7:1160). What is turned by less than a rotation and back gains
/// or loses in every step.
inline Tensor rotation_in(const Tensor& f)
{
  Tensor r = f;
  for (int iteration = 0; iteration < 8; ++iteration) {
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
    const BendingModuli<3> moduli(elastic);
    for (std::size_t k = 0; k < modulus_.size(); ++k)
      modulus_[k] = k >= 9       ? moduli.fibres * 16 / 9
                    : k % 3 == 0 ? moduli.alike * 2 / 3
                                 : moduli.opposite * 2;
  }

  /// From the trial stress to the yield surface. `deviator`: of the stress at the centre, Pa, along
  /// the axes of space; `columns`: as in bending.hpp; `plastic_strain`: before the step.
  BentReturn operator()(Symmetric& deviator, double* columns, const Lanes& plastic_strain) const
  {
    BrickStress t;
    for (std::size_t k = 0; k < t.bending.size(); ++k)
      t.bending[k] = load(columns + k * lane_count);
    const Lanes fibres = squares(t.bending);
    const Lanes limit = yield_.yield_stress + yield_.hardening_modulus * plastic_strain;
    const Lanes centre = 1.5 * deviator.squared();
    // As if all of the stress at the centre were along the fibres.
    const Lanes most = centre + 0.5 * fibres + stdx::sqrt((0.25 * fibres + centre) * fibres);
    if (stdx::none_of(most > limit * limit)) {
      take_no_moments<3>(columns);
      return {};
    }
    const Tensor rotation = rotation_of(columns);
    const Symmetric trial = deviator.turned(rotation.transposed());
    t.deviator = trial;
    const BentReturn flow = cut_back(*this, t, yield_, 1e-6 * shear_modulus_, plastic_strain);
    if (!flow.any) {
      take_no_moments<3>(columns);
      return flow;
    }
    const Symmetric lost = t.deviator + Lanes(-1.0) * trial;
    put_where(flow.yields, deviator + lost.turned(rotation), deviator);
    for (std::size_t k = 0; k < t.bending.size(); ++k) {
      double* stress = columns + k * lane_count;
      store(load(stress) - t.bending[k], stress);
    }
    return flow;
  }

  // For cut_back, and as fast as if they were written there:
  struct Found {
    Lanes squared;                   ///< Q
    Lanes half, root;                ///< half of s^2, rounded; the root in Q
    std::array<Lanes, 3> centre[3];  ///< N along the fibres of each plate
    Lanes product[3];                ///< <N, T>
  };
  [[gnu::always_inline]] Found at(const BrickStress& t, const Lanes& rounded) const
  {
    Found found;
    Lanes products = 0.0;
    for (int j = 0; j < 3; ++j) {
      found.centre[j] = along(t.deviator, j);
      found.product[j] = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        found.product[j] += found.centre[j][k] * t.bending[3 * std::size_t(j) + k];
      products += found.product[j] * found.product[j];
    }
    const Lanes fibres = squares(t.bending);
    found.half = 0.5 * fibres + rounded;
    found.root = stdx::sqrt(found.half * found.half + products);
    found.squared = 1.5 * t.deviator.squared() + 0.5 * fibres + (found.root - rounded);
    return found;
  }
  [[gnu::always_inline]] BrickStress normal(const BrickStress& t, const Found& found,
                                            const Lanes& over) const
  {
    const Lanes half_root = 0.5 / found.root;
    BrickStress n;
    n.deviator = over * t.deviator;
    for (std::size_t k = 0; k < n.bending.size(); ++k)
      n.bending[k] = (0.5 + found.half * half_root) * over * t.bending[k];
    for (int j = 0; j < 3; ++j) {
      const std::size_t first = 3 * std::size_t(j);
      const Lanes factor = found.product[j] * half_root * over;
      add(&t.bending[first], j, factor, n.deviator);
      for (std::size_t k = 0; k < 3; ++k) n.bending[first + k] += factor * found.centre[j][k];
    }
    return n;
  }
  [[gnu::always_inline]] Lanes stiffness(const BrickStress& n) const
  {
    Lanes sum = shear_modulus_ * 1.5 * n.deviator.squared();
    for (std::size_t k = 0; k < n.bending.size(); ++k)
      sum += modulus_[k] * n.bending[k] * n.bending[k];
    return sum;
  }
  [[gnu::always_inline]] void flow(BrickStress& t, const BrickStress& n, const Lanes& amount) const
  {
    t.deviator = t.deviator + (-shear_modulus_ * amount) * n.deviator;
    // A plane that cuts beyond where the moments are gone is of no use there.
    std::array<Lanes, bending_stresses<3>> next;
    Lanes left = 0.0;
    for (std::size_t k = 0; k < next.size(); ++k) {
      next[k] = t.bending[k] - modulus_[k] * amount * n.bending[k];
      left += next[k] * t.bending[k];
    }
    for (std::size_t k = 0; k < next.size(); ++k)
      t.bending[k] = select(left > 0.0, next[k], Lanes(0.0));
  }
  [[gnu::always_inline]] Lanes work(const BrickStress& t, const BrickStress& trial) const
  {
    const Symmetric lost = trial.deviator + Lanes(-1.0) * t.deviator;
    Lanes sum = 1.5 / shear_modulus_ * t.deviator.contracted(lost);
    for (std::size_t k = 0; k < t.bending.size(); ++k)
      sum += t.bending[k] * (trial.bending[k] - t.bending[k]) / modulus_[k];
    return sum;
  }

 private:
  static Lanes squares(const std::array<Lanes, bending_stresses<3>>& parts)
  {
    Lanes sum = 0.0;
    for (const Lanes& part : parts) sum += part * part;
    return sum;
  }
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

  double shear_modulus_;
  std::array<double, bending_stresses<3>> modulus_;  ///< Pa, of the stresses of fibres
  YieldConstants yield_;
};

}  // namespace mpm
