#pragma once
/// Logarithm and exponential of symmetric tensors in the plane, in lanes.

#include <mpm/core/lanes.hpp>

namespace mpm {

/// In-plane logarithmic strain 1/2 ln b_e of a symmetric 2 x 2 tensor with positive eigenvalues
/// l1 >= l2, without its eigenvectors: with the mean m of xx and yy, half their difference h and
/// q = sqrt(h^2 + xy^2) / m,
///   ln b_e = ln(l1 l2) / 2 I + atanh(q) / (q m) {{h, xy}, {xy, -h}}.
struct PlaneStrain {
  Lanes sum;                 ///< e1 + e2
  Lanes difference_xx;       ///< e_xx - e_yy
  Lanes difference_xy;       ///< 2 e_xy
  Lanes difference_squared;  ///< (e1 - e2)^2
};

/// Below this, ten terms of the series of atanh(q) / q in q^2 are exact to rounding.
inline constexpr double series_limit = 0.029;

[[gnu::always_inline]] inline Lanes atanh_over(const Lanes& q_squared, const Lanes& mean,
                                               const Lanes& determinant)
{
  Lanes series = 1.0 / 21;
  for (const int odd : {19, 17, 15, 13, 11, 9, 7, 5, 3, 1}) series = series * q_squared + 1.0 / odd;
  const LaneMask large = q_squared > series_limit;
  if (stdx::any_of(large)) [[unlikely]] {
    const Lanes q = stdx::sqrt(q_squared), first = mean * (1.0 + q);
    stdx::where(large, series) = 0.5 * lane_log(first * first / determinant) / q;
  }
  return series;
}

[[gnu::always_inline]] inline PlaneStrain logarithmic_strain(const Lanes& xx, const Lanes& yy,
                                                             const Lanes& xy)
{
  const Lanes mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
  const Lanes determinant = xx * yy - xy * xy, inverse_mean = 1.0 / mean;
  const Lanes h = half * inverse_mean, s = xy * inverse_mean;
  const Lanes q_squared = h * h + s * s;
  const Lanes factor = atanh_over(q_squared, mean, determinant);
  return {0.5 * lane_log(determinant), factor * h, factor * s, factor * factor * q_squared};
}

/// b_e = exp(2 e): exp(sum) (cosh(d) I + sinh(d) / d {{d_xx, d_xy}, {d_xy, -d_xx}}), d = e1 - e2.
struct PlaneTensor {
  Lanes xx, yy, xy;

  explicit PlaneTensor(const PlaneStrain& e)
  {
    const Lanes d2 = e.difference_squared;
    Lanes cosh = 1.0 / 87178291200.0, sinh_over = 1.0 / 1307674368000.0;
    for (const double f :
         {1.0 / 479001600.0, 1.0 / 3628800.0, 1.0 / 40320.0, 1.0 / 720.0, 1.0 / 24.0, 0.5, 1.0})
      cosh = cosh * d2 + f;
    for (const double f : {1.0 / 6227020800.0, 1.0 / 39916800.0, 1.0 / 362880.0, 1.0 / 5040.0,
                           1.0 / 120.0, 1.0 / 6.0, 1.0})
      sinh_over = sinh_over * d2 + f;
    const LaneMask large = d2 > 0.5;  // beyond, the series lose digits
    if (stdx::any_of(large)) [[unlikely]] {
      const Lanes d = stdx::sqrt(d2), up = lane_exp(d), down = lane_exp(-d);
      stdx::where(large, cosh) = 0.5 * (up + down);
      stdx::where(large, sinh_over) = 0.5 * (up - down) / d;
    }
    const Lanes size = lane_exp(e.sum);
    const Lanes half = size * sinh_over * e.difference_xx;
    xx = size * cosh + half;
    yy = size * cosh - half;
    xy = size * sinh_over * e.difference_xy;
  }
};

}  // namespace mpm
