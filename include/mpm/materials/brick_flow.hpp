#pragma once
/// Von Mises flow of bricks that bend: the deviator at the centre and the moments of the plates
/// across all axes yield together, and flow along the normal of the common surface.

#include <mpm/materials/bending.hpp>
#include <mpm/materials/von_mises_flow.hpp>

namespace mpm {

/// One block's columns of bending.hpp, and what flow leaves of the moments.
struct BrickBending {
  Lanes alike_squared, other_squared;  ///< Pa^2
  Lanes alike_energy, other_energy;    ///< J
  Lanes alike_share = 1.0, other_share = 1.0;

  [[gnu::always_inline]] explicit BrickBending(const double* columns)
      : alike_squared(load(columns)),
        other_squared(load(columns + lane_count)),
        alike_energy(load(columns + 2 * lane_count)),
        other_energy(load(columns + 3 * lane_count))
  {
  }
  [[gnu::always_inline]] void store_shares(double* columns) const
  {
    store(alike_share, columns);
    store(other_share, columns + lane_count);
  }
  /// J, of flow: what is left of the moments times the plastic part of the bending. All that the
  /// energy loses would count the overshoot of the trial, half a step's worth, as work.
  Lanes work() const
  {
    return 2.0 * (alike_share * (1.0 - alike_share) * alike_energy +
                  other_share * (1.0 - other_share) * other_energy);
  }
};

/// Share of the work of flow that is done at the centre beside what is in RadialReturn.
struct BrickReturn : RadialReturn {
  Lanes share_of_centre = 1.0;
};

/// With q^2 of the centre and the squares A of moments that bend alike and D of the others, flow by
/// g = 2 mu times the multiplier leaves (q^2 + D) / (1 + g)^2 + A / (1 + r g)^2, as in plane stress
/// (Simo & Taylor 1986, IJNME 22:649), r = E / (3 (1 - nu)) / 2 mu.
class BrickFlow {
 public:
  BrickFlow(const IsotropicConstants& elastic, const YieldConstants& yield)
      : ratio_((1 + elastic.poisson_ratio) / (3 * (1 - elastic.poisson_ratio))),
        three_mu_(3 * elastic.shear_modulus()),
        yield_(yield)
  {
  }

  /// `squared`: q^2 of the trial stress at the centre, Pa^2; `plastic_strain`: before the step.
  BrickReturn operator()(const Lanes& squared, BrickBending& bending,
                         const Lanes& plastic_strain) const
  {
    BrickReturn result;
    const Lanes& alike = bending.alike_squared;
    const Lanes other = squared + bending.other_squared;
    const Lanes limit = yield_.yield_stress + yield_.hardening_modulus * plastic_strain;
    result.yields = alike + other > limit * limit;
    result.any = stdx::any_of(result.yields);
    if (!result.any) return result;
    // 1 / stress is linear in g without `alike`, and nearly so with it: Newton's method starts from
    // what g would be if all shrank as the others do, and has two or three steps to go.
    constexpr int most_iterations = 20;
    constexpr double tolerance = 1e-12;
    const double slope_of_limit = yield_.hardening_modulus / three_mu_;
    const Lanes inverse_limit = 1.0 / limit;
    const Lanes inverse_trial =
        1.0 / stdx::sqrt(select(result.yields, alike + other, limit * limit));
    Lanes g = (inverse_limit - inverse_trial) / (inverse_trial + slope_of_limit * inverse_limit);
    stdx::where(!result.yields, g) = 0.0;
    Lanes p, r, reached;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      p = 1.0 / (1.0 + g);
      r = 1.0 / (1.0 + ratio_ * g);
      reached = select(result.yields, other * p * p + alike * r * r, Lanes(1.0));
      const Lanes inverse = 1.0 / stdx::sqrt(reached);
      Lanes residual = (1.0 - slope_of_limit * g) * inverse_limit - inverse;
      stdx::where(!result.yields, residual) = 0.0;
      if (stdx::all_of(stdx::abs(residual) * limit <= tolerance)) break;
      const Lanes slope =
          slope_of_limit * inverse_limit +
          inverse * inverse * inverse * (other * p * p * p + ratio_ * alike * r * r * r);
      g += select(result.yields, residual / slope, Lanes(0.0));
    }
    result.scale = p;
    result.plastic_strain = g * stdx::sqrt(reached) / three_mu_;
    result.share_of_centre = squared * p * p / reached;
    bending.other_share = p;
    bending.alike_share = r;
    return result;
  }

 private:
  double ratio_, three_mu_;
  YieldConstants yield_;
};

}  // namespace mpm
