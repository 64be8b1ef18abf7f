/// A program of somebody else: a material law, and the properties of a curve.
#include <mpm/analysis/compression_curve.hpp>
#include <mpm/core/one_of.hpp>
#include <mpm/materials/laws.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

int main()
{
  const mpm::LawRow& row = *mpm::OneOf<mpm::LawRow>("neo_hookean");
  const auto law = mpm::make_law<3>(
      row, {{"density", 1500.0}, {"youngs_modulus", 10e9}, {"poisson_ratio", 0.25}},
      mpm::PlaneAssumption::strain);
  std::vector<double> strain, stress;
  for (int k = 0; k <= 200; ++k) {
    strain.push_back(0.001 * k);
    stress.push_back(2e9 * strain.back());
  }
  const auto found = mpm::analysis::compression_properties(strain, stress, {});
  // E (1 - nu) / ((1 + nu) (1 - 2 nu)) = 1.2 E
  const double expected = std::sqrt(1.2 * 10e9 / 1500.0);
  std::printf("wave speed %.6f of the expected one, modulus %.6f GPa, %d lanes\n",
              law->wave_speed() / expected, 1e-9 * *found.modulus, mpm::lane_count);
}
