#pragma once
/// The return to the yield surface of cells that bend, by cutting planes (Simo & Ortiz 1985, CMAME
/// 49:221), in lanes.

#include <mpm/materials/von_mises_flow.hpp>

namespace mpm {

/// Of the yield stress squared: by what the surfaces of bent_flow.hpp are rounded.
inline constexpr double rounded_vertex = 0.01;

/// Takes the trial stress `t` along normals of `surface` to where its stress, the root of `squared`
/// in what `at(stress, rounded)` finds, is the yield stress. `normal(stress, found, over)` is the
/// slope of that stress, with one over it; `stiffness(normal)` by how much it falls with flow, Pa;
/// `flow(stress, normal, amount)` takes the flow; `work(stress, trial)` is that of what is left
/// over the flow since the trial, per volume. `least_stiffness`: below it there is no stress to
/// flow. `plastic_strain`: before the step. Without flow `t` stays.
template <class Surface, class Stress>
[[gnu::always_inline]] inline BentReturn cut_back(const Surface& surface, Stress& t,
                                                  const YieldConstants& yield,
                                                  double least_stiffness,
                                                  const Lanes& plastic_strain)
{
  constexpr int most_iterations = 30;
  // Of the next to last step: the last one squares it, and no lane hangs on its neighbours.
  constexpr double tolerance = 1e-8;
  BentReturn result;
  const Stress trial = t;
  const Lanes limit = yield.yield_stress + yield.hardening_modulus * plastic_strain;
  const Lanes rounded = rounded_vertex * limit * limit;
  Lanes multiplier = 0.0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto found = surface.at(t, rounded);
    if (iteration == 0) {
      result.yields = found.squared > limit * limit;
      result.any = stdx::any_of(result.yields);
      if (!result.any) return result;
    }
    const Lanes now = limit + yield.hardening_modulus * multiplier;
    const Lanes stress = select(result.yields, stdx::sqrt(found.squared), now);
    const bool last = stdx::all_of(stdx::abs(stress - now) <= tolerance * now);
    const auto normal = surface.normal(t, found, 1.0 / stress);
    const Lanes stiffness = surface.stiffness(normal) + yield.hardening_modulus;
    const Lanes amount = (stress - now) / stdx::max(stiffness, Lanes(least_stiffness));
    multiplier += amount;
    surface.flow(t, normal, amount);
    if (last) break;
  }
  result.plastic_strain = surface.work(t, trial) / (limit + yield.hardening_modulus * multiplier);
  return result;
}

}  // namespace mpm
