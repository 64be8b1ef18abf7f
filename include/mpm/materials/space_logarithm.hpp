#pragma once
/// Logarithm and exponential of symmetric tensors in space, lane by lane, without eigenvectors.
///
/// A deviator X obeys X^3 = J2 X + J3 I with J2 = X : X / 2 and J3 = det X (Cayley and Hamilton),
/// so that every power series in it is c0 I + c1 X + c2 X^2: Horner's scheme multiplies by X with
/// two fused additions. The coefficients are symmetric functions of the eigenvalues and have no
/// trouble where these meet. No eigenvalue of X is larger than sqrt(4 J2 / 3). Lanes beyond the
/// reach of the series take the spectrum.

#include <mpm/materials/space_spectrum.hpp>

#include <array>

namespace mpm {

/// A deviator with what its power series need.
struct Deviator {
  Symmetric x, square;
  Lanes j2, j3;

  [[gnu::always_inline]] explicit Deviator(const Symmetric& deviator)
      : x(deviator),
        square(deviator.times_itself()),
        j2(0.5 * square.trace()),
        j3(deviator.determinant())
  {
  }
  /// Square of a bound of the eigenvalues.
  Lanes reach_squared() const { return 4.0 / 3.0 * j2; }
};

/// c0 I + c1 X + c2 X^2
struct Quadric {
  Lanes c0 = 0.0, c1 = 0.0, c2 = 0.0;

  /// Sum of coefficients[k] X^k.
  template <std::size_t Terms>
  [[gnu::always_inline]] Quadric(const std::array<double, Terms>& coefficients, const Lanes& j2,
                                 const Lanes& j3)
  {
#pragma GCC unroll 32
    for (int k = int(Terms) - 1; k >= 0; --k) {
      const Lanes up = c0 + c2 * j2;
      c0 = coefficients[k] + c2 * j3;
      c2 = c1;
      c1 = up;
    }
  }
};

/// Of ln(1 + x); x^Terms / Terms is what is left out.
template <std::size_t Terms>
inline constexpr std::array<double, Terms> logarithm_series = [] {
  std::array<double, Terms> c{};
  for (std::size_t k = 1; k < Terms; ++k) c[k] = (k % 2 == 1 ? 1.0 : -1.0) / double(k);
  return c;
}();
/// Of exp(x).
template <std::size_t Terms>
inline constexpr std::array<double, Terms> exponential_series = [] {
  std::array<double, Terms> c{1};
  for (std::size_t k = 1; k < Terms; ++k) c[k] = c[k - 1] / double(k);
  return c;
}();

/// e = ln(b) / 2 apart.
struct LogarithmicStrain {
  Lanes trace;
  Symmetric deviator;

  /// From b with positive eigenvalues: ln b = ln m I + ln(I + X), m the mean of b, X = dev b / m.
  [[gnu::always_inline]] explicit LogarithmicStrain(const Symmetric& b)
  {
    // What is left out of ln(1 + x) is below 1e-16 x.
    constexpr double small = 0.1 * 0.1, moderate = 0.3 * 0.3;
    const Lanes mean = b.trace() * (1.0 / 3.0), inverse = 1.0 / mean;
    const Deviator d({(b.xx - mean) * inverse, (b.yy - mean) * inverse, (b.zz - mean) * inverse,
                      b.xy * inverse, b.yz * inverse, b.xz * inverse});
    const Lanes reach = d.reach_squared();
    if (stdx::any_of(reach > small)) [[unlikely]]
      combine(d, Quadric(logarithm_series<29>, d.j2, d.j3), mean);
    else
      combine(d, Quadric(logarithm_series<16>, d.j2, d.j3), mean);
    if (const LaneMask large = reach > moderate; stdx::any_of(large)) [[unlikely]]
      take_spectrum(b, large);
  }

 private:
  [[gnu::always_inline]] void combine(const Deviator& d, const Quadric& f, const Lanes& mean)
  {
    trace = 1.5 * (lane_log(mean) + f.c0) + f.c2 * d.j2;
    const Lanes a = 0.5 * f.c1, c = 0.5 * f.c2, off = (2.0 / 3.0) * d.j2;
    deviator = {a * d.x.xx + c * (d.square.xx - off), a * d.x.yy + c * (d.square.yy - off),
                a * d.x.zz + c * (d.square.zz - off), a * d.x.xy + c * d.square.xy,
                a * d.x.yz + c * d.square.yz,         a * d.x.xz + c * d.square.xz};
  }
  [[gnu::noinline]] void take_spectrum(const Symmetric& b, const LaneMask& large)
  {
    const Symmetric e =
        Spectrum(b).function([](const Lanes& value) { return 0.5 * lane_log(value); });
    stdx::where(large, trace) = e.trace();
    put_where(large, e.deviator(), deviator);
  }
};

/// factor exp(X) of a deviator X.
[[gnu::always_inline]] inline Symmetric exponential_of_deviator(const Symmetric& x,
                                                                const Lanes& factor)
{
  constexpr double small = 0.1 * 0.1, moderate = 0.5 * 0.5;  // left out: below 1e-17
  const Deviator d(x);
  const Lanes reach = d.reach_squared();
  const Quadric f = stdx::any_of(reach > small) ? Quadric(exponential_series<15>, d.j2, d.j3)
                                                : Quadric(exponential_series<11>, d.j2, d.j3);
  const Lanes c0 = factor * f.c0, c1 = factor * f.c1, c2 = factor * f.c2;
  Symmetric result{c0 + c1 * x.xx + c2 * d.square.xx, c0 + c1 * x.yy + c2 * d.square.yy,
                   c0 + c1 * x.zz + c2 * d.square.zz, c1 * x.xy + c2 * d.square.xy,
                   c1 * x.yz + c2 * d.square.yz,      c1 * x.xz + c2 * d.square.xz};
  if (const LaneMask large = reach > moderate; stdx::any_of(large)) [[unlikely]]
    put_where(large,
              Spectrum(x).function([&](const Lanes& value) { return factor * lane_exp(value); }),
              result);
  return result;
}

}  // namespace mpm
