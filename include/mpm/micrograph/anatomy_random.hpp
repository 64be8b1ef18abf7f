#pragma once
/// Random numbers and smooth random fields that are the same on every machine: integers mixed by
/// shifts and multiplications, then + - * / only.

#include <cmath>
#include <cstdint>

namespace mpm::micrograph::anatomy {

/// Finalizer of SplitMix64 (Steele, Lea, Flood 2014): every bit of the key reaches every bit out.
inline std::uint64_t mixed(std::uint64_t key)
{
  key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9U;
  key = (key ^ (key >> 27)) * 0x94D049BB133111EBU;
  return key ^ (key >> 31);
}

/// Top 53 bits as a double in [0, 1).
inline double unit_interval(std::uint64_t bits)
{
  return static_cast<double>(bits >> 11) * (1.0 / 9007199254740992.0);
}

/// What a random number is drawn for: one stream each, so that a change in one part of the tissue
/// leaves the others as they were.
enum class Stream : std::uint64_t {
  layout = 1,
  files,
  rays,
  vessels,
  walls,
  wave_x,
  wave_y,
  rim_x,
  rim_y,
  shading,
  noise,
  tint,
  ends
};

class Random {
 public:
  Random(std::uint64_t seed, Stream stream)
      : state_(mixed(mixed(seed + golden) + static_cast<std::uint64_t>(stream) * golden))
  {
  }

  double uniform() { return unit_interval(mixed(state_ += golden)); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Mean 0, standard deviation 1, never beyond +-3: the sum of three uniforms, scaled.
  double scatter()
  {
    double sum = uniform();
    sum += uniform();
    sum += uniform();
    return 2 * sum - 3;
  }

 private:
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15U;
  std::uint64_t state_;
};

/// Random field in [-1, 1] that varies over `length`: values on a square lattice, joined by a
/// polynomial with continuous first and second derivatives.
class SmoothField {
 public:
  SmoothField(std::uint64_t seed, Stream stream, double length)
      : key_(mixed(mixed(seed) + static_cast<std::uint64_t>(stream))), length_(length)
  {
  }

  double operator()(double x, double y) const
  {
    const double column = std::floor(x / length_), row = std::floor(y / length_);
    const double a = eased(x / length_ - column), b = eased(y / length_ - row);
    const auto i = static_cast<std::int64_t>(column), j = static_cast<std::int64_t>(row);
    const double lower = (1 - a) * value(i, j) + a * value(i + 1, j);
    const double upper = (1 - a) * value(i, j + 1) + a * value(i + 1, j + 1);
    return (1 - b) * lower + b * upper;
  }

 private:
  static double eased(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
  double value(std::int64_t i, std::int64_t j) const
  {
    const std::uint64_t column_key =
        mixed(key_ + static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U);
    return 2 * unit_interval(
                   mixed(column_key + static_cast<std::uint64_t>(j) * 0xD1B54A32D192ED03U)) -
           1;
  }

  std::uint64_t key_;
  double length_;
};

}  // namespace mpm::micrograph::anatomy
