#pragma once
/// Compression curves whose modulus, knee and densification are known because they were put in.

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace mpm::analysis::synthetic {

struct Curve {
  std::vector<double> strain;
  std::vector<double> stress;  ///< Pa
};

// The radial curve of the founding paper's loblolly pine at a yield stress of 500 MPa.
constexpr double modulus = 2740e6;
constexpr double intercept = 4.9e6;
constexpr double buckling_stress = 54.2e6;
constexpr double buckling_strain = 0.0180;
constexpr double plateau_slope = 424e6;
constexpr double kink = 0.271;

/// max(x, 0) with the corner rounded over a few widths.
inline double ramp(double x, double width)
{
  return x > 30 * width ? x : width * std::log1p(std::exp(x / width));
}

/// Elastic line, plateau from the knee on, a parabola from the kink on; corners rounded.
inline double wood(double strain)
{
  const double dense = ramp(strain - kink, 0.004);
  return intercept + modulus * strain -
         (modulus - plateau_slope) * ramp(strain - buckling_strain, 0.0035) + 4.5e9 * dense +
         30e9 * dense * dense;
}

// Tangential compression of the shipped loblolly: lumens of rays close first, then the wood bears.
constexpr double soft_modulus = 900e6;
constexpr double steep_modulus = 4500e6;
constexpr double soft_end = 0.04;
constexpr double steep_end = 0.08;

/// A soft start, a steep line, a plateau and a denser part; corners rounded.
inline double wood_with_a_toe(double strain)
{
  return soft_modulus * strain + (steep_modulus - soft_modulus) * ramp(strain - soft_end, 0.002) -
         (steep_modulus - 800e6) * ramp(strain - steep_end, 0.0035) +
         6e9 * ramp(strain - 0.35, 0.004);
}

template <class Stress>
Curve sample(Stress&& stress, double end, int count)
{
  Curve curve;
  for (int i = 1; i <= count; ++i) {
    curve.strain.push_back(end * i / count);
    curve.stress.push_back(stress(curve.strain.back()));
  }
  return curve;
}

/// White noise and ringing of a 0.4 % period, both with an amplitude of `share` of sigma_b.
inline Curve noisy(Curve curve, double share)
{
  std::mt19937_64 generator(7);
  std::normal_distribution<double> noise(0, share * buckling_stress);
  for (std::size_t i = 0; i < curve.strain.size(); ++i)
    curve.stress[i] +=
        noise(generator) +
        share * buckling_stress * std::sin(2 * std::numbers::pi * curve.strain[i] / 0.004 + 0.5);
  return curve;
}

}  // namespace mpm::analysis::synthetic
