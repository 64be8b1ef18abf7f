#pragma once
/// Von Mises flow of bricks that bend: the deviator at the centre and the moments of the plates
/// across all axes yield together, and flow along the normal of the common surface,
///   Q = q^2 + s^2 / 2 + sqrt(s^4 / 4 + <N, T>^2) <= s_Y^2,
/// that of shells (Ilyushin 1948, in the form of Ivanov 1967) as in bent_flow.hpp: N the deviator
/// at the centre, T = +- T_1 +- T_2 +- T_3 that of the fibres of all plates where they cross, with
/// those signs for which it is largest, <N, T> = 3/2 N : T, q^2 = <N, N>, and s^2 = <T, T> and the
/// squares of warping. Rounded as there.

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
  Lanes sign[3] = {1.0, 1.0, 1.0};                 ///< of each plate's in that where they cross
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
    const Lanes limit = yield_.yield_stress + yield_.hardening_modulus * plastic_strain;
    const Lanes centre = 1.5 * deviator.squared();
    // At most, as if all of the stress at the centre were along the fibres.
    const auto none_yields = [&](const Lanes& fibres) {
      const Lanes most = centre + 0.5 * fibres + stdx::sqrt((0.25 * fibres + centre) * fibres);
      return stdx::none_of(most > limit * limit);
    };
    if (none_yields(most_of(t.bending))) {
      take_no_moments<3>(columns);
      return {};
    }
    choose_signs(t);
    if (none_yields(squared(t, crossed(t)))) {
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
    Lanes squared;     ///< Q
    Lanes half, root;  ///< half of s^2, rounded; the root in Q
    Symmetric fibres;  ///< T
    Lanes product;     ///< <N, T>
  };
  /// What a plate has in common with the others.
  struct Crossing {
    std::array<Lanes, 3> along;  ///< of the others' T: <T, T_j> is the product with parts of T_j
    Lanes excess;                ///< that product, with the plate's sign, beyond rounding
    Lanes stiffness;             ///< by how much it changes with flow along them
  };
  struct Normal {
    Symmetric deviator;
    std::array<Lanes, bending_stresses<3>> bending;
    Crossing crossing[3];  ///< of the plates of the stress that it is of
  };
  [[gnu::always_inline]] Found at(const BrickStress& t, const Lanes& rounded) const
  {
    Found found;
    found.fibres = crossed(t);
    found.half = 0.5 * squared(t, found.fibres) + rounded;
    found.product = 1.5 * t.deviator.contracted(found.fibres);
    found.root = stdx::sqrt(found.half * found.half + found.product * found.product);
    found.squared = 1.5 * t.deviator.squared() + found.half + found.root - 2.0 * rounded;
    return found;
  }
  [[gnu::always_inline]] Normal normal(const BrickStress& t, const Found& found,
                                       const Lanes& over) const
  {
    const Lanes of_root = 0.5 / found.root * over, of_product = found.product * of_root,
                of_fibres = 0.5 * over + found.half * of_root;
    Normal n;
    n.deviator = over * t.deviator + of_product * found.fibres;
    const Symmetric by_fibres = of_fibres * found.fibres + of_product * t.deviator;
    for (int j = 0; j < 3; ++j) {
      const std::size_t first = 3 * std::size_t(j);
      const std::array<Lanes, 3> slope = along(by_fibres, j);
      const Crossing& others = n.crossing[j] = crossing(t, found.fibres, j);
      // What does not depend on the plate's sign, and the rest. At right angles to the others' T
      // both signs are as good: with that share of either slope with which it stays there.
      const std::array<Lanes, 3> centre = along(t.deviator, j);
      const Lanes product = of_root * dot(centre, &t.bending[first]);
      std::array<Lanes, 3> own, rest;
      Lanes by_own = 0.0, by_rest = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        own[k] = of_fibres * t.bending[first + k] + product * centre[k];
        rest[k] = t.sign[j] * slope[k] - own[k];
        const Lanes weighted = t.sign[j] * modulus_[first + k] * others.along[k];
        by_own += weighted * own[k];
        by_rest += weighted * rest[k];
      }
      const Lanes still = -by_own / stdx::max(by_rest, Lanes(least));
      const Lanes share = select(others.excess <= 0.0,
                                 stdx::min(stdx::max(still, Lanes(-1.0)), Lanes(1.0)), Lanes(1.0));
      for (std::size_t k = 0; k < 3; ++k) n.bending[first + k] = own[k] + share * rest[k];
    }
    for (std::size_t k = first_warping; k < n.bending.size(); ++k)
      n.bending[k] = of_fibres * t.bending[k];
    return n;
  }
  [[gnu::always_inline]] Lanes stiffness(const Normal& n) const
  {
    Lanes sum = shear_modulus_ * 1.5 * n.deviator.squared();
    for (std::size_t k = 0; k < n.bending.size(); ++k)
      sum += modulus_[k] * n.bending[k] * n.bending[k];
    return sum;
  }
  [[gnu::always_inline]] void flow(BrickStress& t, const Normal& n, const Lanes& amount) const
  {
    t.deviator = t.deviator + (-shear_modulus_ * amount) * n.deviator;
    // A plane that cuts beyond where the moments are gone is of no use there.
    std::array<Lanes, bending_stresses<3>> next;
    Lanes left = 0.0;
    for (std::size_t k = 0; k < next.size(); ++k) {
      next[k] = t.bending[k] - modulus_[k] * amount * n.bending[k];
      left += next[k] * t.bending[k];
    }
    for (int j = 0; j < 3; ++j) {
      // Nor one beyond where a plate's fibres and the others' are at right angles.
      const Crossing& others = n.crossing[j];
      Lanes* part = &next[3 * std::size_t(j)];
      const Lanes product = dot(others.along, part);
      const Lanes back = select(t.sign[j] * product < 0.0, product / others.stiffness, Lanes(0.0));
      for (std::size_t k = 0; k < 3; ++k)
        part[k] -= back * modulus_[3 * std::size_t(j) + k] * others.along[k];
    }
    for (std::size_t k = 0; k < next.size(); ++k)
      t.bending[k] = select(left > 0.0, next[k], Lanes(0.0));
    choose_signs(t);
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
  static constexpr std::size_t first_warping = 9;

  static Lanes dot(const std::array<Lanes, 3>& slope, const Lanes* part)
  {
    return slope[0] * part[0] + slope[1] * part[1] + slope[2] * part[2];
  }
  /// s^2
  static Lanes squared(const BrickStress& t, const Symmetric& fibres)
  {
    Lanes sum = 1.5 * fibres.squared();
    for (std::size_t k = first_warping; k < t.bending.size(); ++k)
      sum += t.bending[k] * t.bending[k];
    return sum;
  }
  /// Of s^2: plates as if they all had fibres alike.
  static Lanes most_of(const std::array<Lanes, bending_stresses<3>>& parts)
  {
    Lanes plates = 0.0, warping = 0.0;
    for (std::size_t k = 0; k < parts.size(); k += 3) {
      const Lanes squares =
          parts[k] * parts[k] + parts[k + 1] * parts[k + 1] + parts[k + 2] * parts[k + 2];
      if (k < first_warping)
        plates += stdx::sqrt(squares);
      else
        warping = squares;
    }
    return plates * plates + warping;
  }
  /// The deviator of the fibres of plate j.
  static Symmetric plate(const BrickStress& t, int j)
  {
    Symmetric sum{};
    add(&t.bending[3 * std::size_t(j)], j, Lanes(1.0), sum);
    return sum;
  }
  /// T
  static Symmetric crossed(const BrickStress& t)
  {
    Symmetric sum{};
    for (int j = 0; j < 3; ++j) add(&t.bending[3 * std::size_t(j)], j, t.sign[j], sum);
    return sum;
  }
  /// Those for which T is largest.
  static void choose_signs(BrickStress& t)
  {
    const Symmetric x = plate(t, 0), y = plate(t, 1), z = plate(t, 2);
    const Lanes xy = x.contracted(y), yz = y.contracted(z), xz = x.contracted(z);
    Lanes most = xy + yz + xz;
    t.sign[1] = t.sign[2] = 1.0;
    const auto better = [&](const Lanes& sum, double of_y, double of_z) {
      t.sign[1] = select(sum > most, Lanes(of_y), t.sign[1]);
      t.sign[2] = select(sum > most, Lanes(of_z), t.sign[2]);
      most = stdx::max(sum, most);
    };
    better(xy - yz - xz, 1, -1);
    better(xz - xy - yz, -1, 1);
    better(yz - xy - xz, -1, -1);
  }

  /// Of plate j.
  Crossing crossing(const BrickStress& t, const Symmetric& fibres, int j) const
  {
    const std::size_t first = 3 * std::size_t(j);
    Symmetric others = fibres;
    add(&t.bending[first], j, -t.sign[j], others);
    Crossing found{along(others, j), Lanes(0.0), Lanes(least)};
    found.excess = t.sign[j] * dot(found.along, &t.bending[first]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Lanes &part = t.bending[first + k], &slope = found.along[k];
      found.excess -= 1e-12 * (part * part + slope * slope);
      // Others of no size beside the plate's have no direction.
      found.stiffness += modulus_[first + k] * (slope * slope + 1e-20 * part * part);
    }
    return found;
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

  static constexpr double least = 1e-30;  ///< against division by zero

  double shear_modulus_;
  std::array<double, bending_stresses<3>> modulus_;  ///< Pa, of the stresses of fibres
  YieldConstants yield_;
};

}  // namespace mpm
