#pragma once
/// Von Mises flow of cells of the plane that bend: stress at the centre and moments yield together.
///
/// A wall whose fibres yield all through bears a moment m (over the plastic one) beside a stress n
/// along the fibres (over the yield stress) with m + n^2 = 1: the yield surface of shells (Ilyushin
/// 1948), here in the form
///   Q = q^2 + s^2 / 2 + sqrt(s^4 / 4 + g^2 s^2) <= s_Y^2
/// (Ivanov 1967) with s the von Mises stress of fibres that bear the moments and g the part of q
/// along the fibres. Beside a stress p that strains fibres along themselves not at all it leaves
/// m^2 + p^2 = 1, as if that were the same in all of them: up to 6.5 % less than they could bear.
/// Flow is normal to it: walls of two cells, or four, stop at the plastic moment as those of one
/// do.
/// Stresses along x that depend on y alone, and along y on x alone, are in equilibrium: where
/// fibres along both axes of a cell bear moments, s is the von Mises stress where drawn ones cross
/// pressed ones, s^2 = s_1^2 + s_2^2 + 2 s_1 s_2 in plane strain and + s_1 s_2 in plane stress, and
/// g s = s_1 |g_1| + s_2 |g_2|. In plane strain that is all that such fields bear,
/// m_1 + m_2 + n^2 = 1 (theorem of the lower bound: Drucker, Prager & Greenberg 1952, Q. Appl.
/// Math. 9:381).
/// A cell whose fibres all yield along themselves would then bend at no cost, and rounding would
/// grow: where moments vanish the surface is rounded, with
///   sqrt((s^2 / 2 + e)^2 + g^2 s^2) - e,  e = rounded_vertex s_Y^2
/// for the root, which adds up to half of rounded_vertex to what a wall bears.

#include <mpm/materials/bending.hpp>
#include <mpm/materials/cutting_planes.hpp>
#include <mpm/materials/elastic_constants.hpp>

#include <cmath>

namespace mpm {

/// Along the middle of a cell, from the columns of bending.hpp: cosine and sine of twice the angle
/// by which its axes have turned.
struct FibreDirection {
  Lanes cosine, sine;

  explicit FibreDirection(const double* bending)
  {
    const auto f = [bending](int k) {
      return load(bending + (bending_stresses<2> + k) * lane_count);
    };
    const Lanes x = f(0) + f(3), y = f(1) - f(2);
    const Lanes xx = x * x, yy = y * y, inverse = 1.0 / (xx + yy);
    cosine = (xx - yy) * inverse;
    sine = 2.0 * x * y * inverse;
  }
};

/// Stresses of a cell in parts, Pa. The squares of the first three add up to that of the von Mises
/// stress at the centre.
struct BentStress {
  Lanes mean;        ///< of both normal stresses (plane stress), or 3 times that of their deviators
  Lanes along;       ///< sqrt(3/4) times their difference, seen from the fibres
  Lanes shear;       ///< sqrt(3) times
  Lanes bending[2];  ///< sizes of s_1 and s_2
};

class BentFlow {
 public:
  BentFlow(PlaneAssumption plane, const IsotropicConstants& elastic, const YieldConstants& yield)
      : of_fibres_(plane == PlaneAssumption::strain ? std::sqrt(0.75) : 1.0),
        along_mean_(plane == PlaneAssumption::strain ? 0.0 : 0.5),
        along_difference_(plane == PlaneAssumption::strain ? 1.0 : std::sqrt(0.75)),
        crossed_(plane == PlaneAssumption::strain ? 1.0 : 0.5),
        shear_modulus_(3 * elastic.shear_modulus()),
        mean_modulus_(plane == PlaneAssumption::strain
                          ? shear_modulus_
                          : elastic.youngs_modulus / (2 * (1 - elastic.poisson_ratio))),
        // Of the energy M (V0 h^2 / 12) b^2 / 2 with s = of_fibres M h b / 3.
        bending_modulus_(elastic.bending_modulus(plane) * of_fibres_ * of_fibres_ * 4 / 3),
        yield_(yield)
  {
  }

  /// `bending` is the von Mises stress of fibres, from the columns of bending.hpp. Those of the
  /// plane are held along z in plane strain: their plastic moment is 2 / sqrt(3) times that of
  /// uniaxial stress.
  BentStress stress(const Lanes& mean, const Lanes& along, const Lanes& shear,
                    const double* columns) const
  {
    return {mean,
            along,
            shear,
            {of_fibres_ * stdx::abs(load(columns)),
             of_fibres_ * stdx::abs(load(columns + lane_count))}};
  }

  /// From the trial stress t to the yield surface. `plastic_strain`: before the step.
  BentReturn operator()(BentStress& t, const Lanes& plastic_strain) const
  {
    return cut_back(*this, t, yield_, 1e-6 * shear_modulus_, plastic_strain);
  }

  // For cut_back, and as fast as if they were written there:
  struct Found {
    Lanes squared;     ///< Q
    Lanes g[2];        ///< along the fibres of either axis
    Lanes weighted;    ///< g s
    Lanes half, root;  ///< half of s^2, rounded; the root in Q
  };
  [[gnu::always_inline]] Found at(const BentStress& t, const Lanes& rounded) const
  {
    const Lanes mean = along_mean_ * t.mean, difference = along_difference_ * t.along;
    const Lanes x = mean + difference, y = mean - difference;
    const Lanes half =
        0.5 * (t.bending[0] * crossed(t, 0) + t.bending[1] * crossed(t, 1)) + rounded;
    const Lanes weighted = t.bending[0] * stdx::abs(x) + t.bending[1] * stdx::abs(y);
    const Lanes root = stdx::sqrt(half * half + weighted * weighted);
    return {t.mean * t.mean + t.along * t.along + t.shear * t.shear + half + root - 2.0 * rounded,
            {x, y},
            weighted,
            half,
            root};
  }
  [[gnu::always_inline]] BentStress normal(const BentStress& t, const Found& found,
                                           const Lanes& over) const
  {
    const Lanes of_root = 0.5 / found.root, of_weighted = found.weighted * of_root;
    const Lanes x = of_weighted * stdx::copysign(t.bending[0], found.g[0]),
                y = of_weighted * stdx::copysign(t.bending[1], found.g[1]);
    const Lanes of_s = 0.5 + found.half * of_root;
    const auto bending = [&](int k) {
      // A moment that is gone has no part in the flow.
      return select(t.bending[k] > 0.0,
                    (crossed(t, k) * of_s + of_weighted * stdx::abs(found.g[k])) * over,
                    Lanes(0.0));
    };
    return {(t.mean + along_mean_ * (x + y)) * over,
            (t.along + along_difference_ * (x - y)) * over,
            t.shear * over,
            {bending(0), bending(1)}};
  }
  [[gnu::always_inline]] Lanes stiffness(const BentStress& n) const
  {
    return mean_modulus_ * n.mean * n.mean +
           shear_modulus_ * (n.along * n.along + n.shear * n.shear) +
           bending_modulus_ * (n.bending[0] * n.bending[0] + n.bending[1] * n.bending[1]);
  }
  [[gnu::always_inline]] void flow(BentStress& t, const BentStress& n, const Lanes& amount) const
  {
    t.mean -= mean_modulus_ * amount * n.mean;
    t.along -= shear_modulus_ * amount * n.along;
    t.shear -= shear_modulus_ * amount * n.shear;
    for (int k = 0; k < 2; ++k)
      t.bending[k] = stdx::max(t.bending[k] - bending_modulus_ * amount * n.bending[k], Lanes(0.0));
  }
  [[gnu::always_inline]] Lanes work(const BentStress& t, const BentStress& trial) const
  {
    return t.mean * (trial.mean - t.mean) / mean_modulus_ +
           (t.along * (trial.along - t.along) + t.shear * (trial.shear - t.shear)) /
               shear_modulus_ +
           (t.bending[0] * (trial.bending[0] - t.bending[0]) +
            t.bending[1] * (trial.bending[1] - t.bending[1])) /
               bending_modulus_;
  }

  /// What is taken of the moments, into the columns of bending.hpp.
  static void take(const BentStress& before, const BentStress& after, double* columns)
  {
    constexpr double least = 1e-30;  // Pa, against division by zero
    for (int j = 0; j < bending_stresses<2>; ++j) {
      double* stress = columns + j * lane_count;
      const Lanes was = before.bending[j];
      store((was - after.bending[j]) / stdx::max(was, Lanes(least)) * load(stress), stress);
    }
  }

 private:
  /// Half of the derivative of s^2 by s_k.
  Lanes crossed(const BentStress& t, int k) const
  {
    return t.bending[k] + crossed_ * t.bending[1 - k];
  }

  double of_fibres_;                      ///< of the von Mises stress in that along fibres
  double along_mean_, along_difference_;  ///< g
  double crossed_;                        ///< half of what s_1 s_2 counts in s^2
  double shear_modulus_, mean_modulus_, bending_modulus_;  ///< Pa, of the parts of BentStress
  YieldConstants yield_;
};

}  // namespace mpm
