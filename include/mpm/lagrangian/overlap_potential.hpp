#pragma once
/// What an overlap of two cells counts as, and what all on one side of a cell store together.

#include <algorithm>

namespace mpm {

/// Of the share of a cell that another one lies on: s = a^2 / (2 onset) up to the onset, a -
/// onset/2 beyond. With a stiffness that sets in at once, every cell that begins to touch, and
/// every one that slides on to the next, is a kick of the order of the step.
struct OverlapShare {
  static constexpr double onset = 0.005;

  double value, slope;

  explicit OverlapShare(double share) : slope(std::min(1 / onset * share, 1.0))
  {
    // Nobody foresees on which side it is: no branch.
    const bool sets_in = share < onset;
    value =
        double(sets_in) * (0.5 / onset * share * share) + double(!sets_in) * (share - 0.5 * onset);
  }
};

/// Of the shares s_d on one side of a cell, T their sum: each stores s_d H(T) of kappa C and the
/// area of a cell, so that the pressure on a flush face is G' = T + T^3 / b^2, with G = T H. It
/// hardens, so that the dense state does not lose its volume to overlaps: 1 % of the volume is 3 %
/// of the pressure there.
struct OverlapPotential {
  static constexpr double hardening = 0.03;                      ///< b
  static constexpr double harder = 1 / (hardening * hardening);  ///< 1/b^2

  double part;   ///< H = T / 2 + T^3 / (4 b^2)
  double slope;  ///< H'

  explicit OverlapPotential(double together)
  {
    const double hard = together * together * harder;
    part = together * (0.5 + 0.25 * hard);
    slope = 0.5 + 0.75 * hard;
  }
  double pressure(double together) const { return part + together * slope; }
  static double stiffness(double together) { return 1 + 3 * together * together * harder; }
};

}  // namespace mpm
