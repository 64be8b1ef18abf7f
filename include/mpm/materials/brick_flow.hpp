#pragma once
/// Von Mises flow of bricks that bend: the deviator at the centre and the moments of the plates
/// across all axes yield together, and flow along the normal of the common surface,
///   Q = q^2 + s^2 / 2 + sqrt(s^4 / 4 + <N, T>^2) <= s_Y^2,
/// that of shells (Ilyushin 1948, in the form of Ivanov 1967) as in bent_flow.hpp: N the deviator
/// at the centre, T = +- T_1 +- T_2 +- T_3 that of the fibres of all plates where they cross,
/// <N, T> = 3/2 N : T, q^2 = <N, N>, and s^2 = <T, T> and the squares of warping; of the four
/// crossings that differ the one with the largest Q. Rounded as there, and by as much where
/// crossings are as good as each other: in place of the largest stands e ln(1/4 sum exp(Q / e)),
/// e = rounded_vertex s_Y^2, which leaves a plate by itself as it is, and adds up to 0.35 % where
/// two cross and 0.7 % where three do. With half of that width rounding grew, where a step is long
/// beside it.

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
    const Lanes limit = yield_.yield_stress + yield_.hardening_modulus * plastic_strain;
    const Lanes centre = 1.5 * deviator.squared();
    // At most, as if all of the stress at the centre were along the fibres.
    const auto none_yields = [&](const Lanes& fibres) {
      const Lanes most = centre + 0.5 * fibres + stdx::sqrt((0.25 * fibres + centre) * fibres);
      return stdx::none_of(most > limit * limit);
    };
    if (none_yields(most_of(t.bending)) || none_yields(largest_of(Crossings(t.bending).squared))) {
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
    Lanes squared;                ///< Q
    std::array<Symmetric, 3> of;  ///< of each plate, of its fibres
    // Means over the crossings:
    Lanes fibres = 0.0;                  ///< of the derivative of Q by s^2
    Lanes crossed[3] = {0.0, 0.0, 0.0};  ///< of that, times the signs of the plates beside each
    Lanes centre[3] = {0.0, 0.0, 0.0};   ///< of half of that by <N, T>, times each one's sign
  };
  [[gnu::always_inline]] Found at(const BrickStress& t, const Lanes& rounded) const
  {
    const Crossings crossings(t.bending);
    Lanes products[3], half[4], root[4], product[4], value[4], share[4];
    for (std::size_t j = 0; j < 3; ++j) products[j] = 1.5 * t.deviator.contracted(crossings.of[j]);
    for (std::size_t c = 0; c < 4; ++c) {
      half[c] = 0.5 * crossings.squared[c] + rounded;
      const auto& [x, y, z] = signs[c];
      product[c] = x * products[0] + y * products[1] + z * products[2];
      root[c] = stdx::sqrt(half[c] * half[c] + product[c] * product[c]);
      value[c] = half[c] + root[c];
    }
    const Lanes largest = largest_of(value), inverse = 1.0 / rounded;
    Lanes sum = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
      share[c] = lane_exp(stdx::max((value[c] - largest) * inverse, Lanes(-700.0)));
      sum += share[c];
    }
    Found found{.squared = 1.5 * t.deviator.squared() + largest + rounded * lane_log(0.25 * sum) -
                           2.0 * rounded,
                .of = crossings.of};
    const Lanes of_each = 0.5 / sum;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& [x, y, z] = signs[c];
      const Lanes part = of_each * share[c], of_root = part / root[c];
      const Lanes fibres = part + half[c] * of_root, centre = product[c] * of_root;
      found.fibres += fibres;
      found.crossed[0] += y * z * fibres;
      found.crossed[1] += x * z * fibres;
      found.crossed[2] += x * y * fibres;
      found.centre[0] += x * centre;
      found.centre[1] += y * centre;
      found.centre[2] += z * centre;
    }
    return found;
  }
  [[gnu::always_inline]] BrickStress normal(const BrickStress& t, const Found& found,
                                            const Lanes& over) const
  {
    BrickStress n{over * t.deviator, {}};
    for (int j = 0; j < 3; ++j) {
      const int next = (j + 1) % 3, last = (j + 2) % 3;
      const Lanes centre = found.centre[j] * over;
      n.deviator = n.deviator + centre * found.of[std::size_t(j)];
      const std::array<Lanes, 3> of_others =
          along(centre * t.deviator + found.crossed[last] * over * found.of[std::size_t(next)] +
                    found.crossed[next] * over * found.of[std::size_t(last)],
                j);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t part = 3 * std::size_t(j) + k;
        n.bending[part] = found.fibres * over * t.bending[part] + of_others[k];
      }
    }
    for (std::size_t k = first_warping; k < n.bending.size(); ++k)
      n.bending[k] = found.fibres * over * t.bending[k];
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
  static constexpr std::size_t first_warping = 9;
  static constexpr double signs[4][3] = {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};

  /// Where fibres of all plates cross, by the signs of theirs.
  struct Crossings {
    std::array<Symmetric, 3> of;  ///< of each plate, of its fibres
    Lanes squared[4];             ///< s^2

    [[gnu::always_inline]] explicit Crossings(const std::array<Lanes, bending_stresses<3>>& bending)
    {
      Lanes apart = 0.0;
      for (const Lanes& part : bending) apart += part * part;
      for (int j = 0; j < 3; ++j) of[std::size_t(j)] = plate(&bending[3 * std::size_t(j)], j);
      const Lanes yz = 3.0 * of[1].contracted(of[2]), xz = 3.0 * of[0].contracted(of[2]),
                  xy = 3.0 * of[0].contracted(of[1]);
      for (std::size_t c = 0; c < 4; ++c) {
        const auto& [x, y, z] = signs[c];
        squared[c] = apart + y * z * yz + x * z * xz + x * y * xy;
      }
    }
  };
  static Lanes largest_of(const Lanes (&values)[4])
  {
    return stdx::max(stdx::max(values[0], values[1]), stdx::max(values[2], values[3]));
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
  /// The deviator of the stress of plate j's fibres, from their parts.
  static Symmetric plate(const Lanes* part, int j)
  {
    const Lanes third = part[0] / 3.0, half = part[1] / std::sqrt(3.0),
                shear = part[2] / std::sqrt(3.0), none = 0.0;
    const Lanes across = -2.0 * third, first = third + half, second = third - half;
    switch (j) {
      case 0:
        return {across, first, second, none, shear, none};
      case 1:
        return {second, across, first, none, none, shear};
      default:
        return {first, second, across, shear, none, none};
    }
  }

  double shear_modulus_;
  std::array<double, bending_stresses<3>> modulus_;  ///< Pa, of the stresses of fibres
  YieldConstants yield_;
};

}  // namespace mpm
