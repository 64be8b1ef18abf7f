#pragma once
/// Lanes: particles side by side in one vector register of the machine the code is built for.

#include <bit>
#include <cstdint>
#include <experimental/simd>

namespace mpm {

namespace stdx = std::experimental;

using Lanes = stdx::native_simd<double>;
using LaneMask = Lanes::mask_type;
inline constexpr int lane_count = int(Lanes::size());
/// Columns of particle blocks start on this boundary, bytes.
inline constexpr std::size_t lane_alignment = 64;

/// A short vector of the values of one node or one particle.
template <int Width>
using Record = stdx::simd<double, stdx::simd_abi::deduce_t<double, Width>>;

inline Lanes load(const double* column)
{
  return Lanes(column, stdx::vector_aligned);
}

inline void store(const Lanes& values, double* column)
{
  values.copy_to(column, stdx::vector_aligned);
}

/// `condition ? a : b`, lane by lane.
inline Lanes select(const LaneMask& condition, const Lanes& a, const Lanes& b)
{
  Lanes result = b;
  stdx::where(condition, result) = a;
  return result;
}

/// {a, a, b, b}
inline Record<4> pairs(double a, double b)
{
  Record<4> result = a;
  stdx::where(Record<4>([](auto k) { return k; }) > 1.5, result) = Record<4>(b);
  return result;
}

/// Natural logarithm of positive finite lanes to 1 ulp or so: exponent split, then
/// ln m = 2 atanh((m - 1) / (m + 1)) as an odd series, |argument| < 0.172.
inline Lanes lane_log(const Lanes& value)
{
  // Shifted without a sign: with one, libstdc++ 12 shifts an int by 32, of which Clang makes anything.
  using Bits = stdx::rebind_simd_t<std::uint64_t, Lanes>;
  using Integers = stdx::rebind_simd_t<std::int64_t, Lanes>;
  const auto bits = std::bit_cast<Bits>(value);
  Lanes exponent = stdx::static_simd_cast<Lanes>(std::bit_cast<Integers>(bits >> 52) - 1023);
  Lanes m = std::bit_cast<Lanes>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  const LaneMask large = m > 1.4142135623730951;
  stdx::where(large, m) = 0.5 * m;
  stdx::where(large, exponent) = exponent + 1.0;
  const Lanes z = (m - 1.0) / (m + 1.0);
  const Lanes z2 = z * z;
  Lanes s = 1.0 / 19;
  for (const int odd : {17, 15, 13, 11, 9, 7, 5, 3}) s = s * z2 + 1.0 / odd;
  return exponent * 0.6931471805599453 + 2.0 * z * (s * z2 + 1.0);
}

/// exp of lanes in [-700, 700] to 1 ulp or so: 2^k times a Taylor series on |r| < ln(2) / 2.
inline Lanes lane_exp(const Lanes& value)
{
  using Bits = stdx::rebind_simd_t<std::int64_t, Lanes>;
  // Adding and taking away 1.5 * 2^52 rounds to the nearest integer, which stays in the low bits.
  const Lanes shifter = 6755399441055744.0;
  const Lanes shifted = value * 1.4426950408889634 + shifter;
  const Lanes k = shifted - shifter;
  const Lanes r = (value - k * 0.693147180369123816490) - k * 1.90821492927058770002e-10;
  Lanes s = 1.0 / 6227020800.0;
  for (const double inverse_factorial :
       {1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0,
        1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0})
    s = s * r + inverse_factorial;
  const auto exponent = (std::bit_cast<Bits>(shifted) - std::bit_cast<Bits>(shifter) + 1023) << 52;
  return s * std::bit_cast<Lanes>(exponent);
}

}  // namespace mpm
