#pragma once
/// Von Mises flow with linear hardening, in lanes: the return to the yield surface along the
/// deviator and what is booked of it.

#include <mpm/core/lanes.hpp>
#include <mpm/materials/elastic_constants.hpp>

namespace mpm {

/// What one step of flow does to the deviator.
struct RadialReturn {
  Lanes scale = 1.0;           ///< of the deviator
  Lanes plastic_strain = 0.0;  ///< increment of the equivalent plastic strain
  LaneMask yields{false};
  bool any = false;  ///< whether any lane yields
};

/// Radial return (Wilkins 1964; Simo & Hughes 1998, box 3.1).
class RadialFlow {
 public:
  /// Of deviators of the Kirchhoff or Cauchy stress.
  static RadialFlow of_stress(double shear_modulus, const YieldConstants& yield)
  {
    return {1, 3 * shear_modulus, yield, shear_modulus};
  }
  /// Of deviators of the elastic strain, 1 / (2 mu) of those of the stress.
  static RadialFlow of_strain(double shear_modulus, const YieldConstants& yield)
  {
    return {2 * shear_modulus, 1.5, yield, shear_modulus};
  }

  /// `squared`: 3/2 d : d of the trial deviators d. `plastic_strain`: before the step.
  RadialReturn operator()(const Lanes& squared, const Lanes& plastic_strain) const
  {
    RadialReturn result;
    const Lanes limit =
        (yield_.yield_stress + yield_.hardening_modulus * plastic_strain) * inverse_unit_;
    result.yields = squared > limit * limit;
    result.any = stdx::any_of(result.yields);
    if (!result.any) return result;
    const Lanes q = stdx::sqrt(squared);
    stdx::where(result.yields, result.plastic_strain) =
        unit_ * (q - limit) / (three_mu_ + yield_.hardening_modulus);
    stdx::where(result.yields, result.scale) = 1.0 - slope_ * result.plastic_strain / q;
    return result;
  }

 private:
  RadialFlow(double unit, double slope, const YieldConstants& yield, double shear_modulus)
      : unit_(unit),
        inverse_unit_(1 / unit),
        slope_(slope),
        three_mu_(3 * shear_modulus),
        yield_(yield)
  {
  }

  double unit_, inverse_unit_;  ///< Pa, of the deviators
  double slope_;                ///< by how much q falls with the plastic strain, in the unit
  double three_mu_;
  YieldConstants yield_;
};

/// What flow of a cell that bends takes.
struct BentReturn {
  Lanes plastic_strain = 0.0;  ///< increment of the equivalent plastic strain
  LaneMask yields{false};
  bool any = false;  ///< whether any lane yields
};

/// Columns of a law's state.
struct FlowColumns {
  int volume, plastic_strain, plastic_work;
};

/// Adds an increment of plastic strain to one block's state, and its work.
inline void record_flow(double* state, const FlowColumns& columns, const YieldConstants& yield,
                        const Lanes& increment)
{
  const auto column = [state](int index) { return state + index * lane_count; };
  const Lanes strain = load(column(columns.plastic_strain)) + increment;
  const Lanes stress = yield.yield_stress + yield.hardening_modulus * strain;
  store(strain, column(columns.plastic_strain));
  store(load(column(columns.plastic_work)) + load(column(columns.volume)) * stress * increment,
        column(columns.plastic_work));
}

}  // namespace mpm
