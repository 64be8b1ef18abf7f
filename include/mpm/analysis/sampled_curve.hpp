#pragma once
/// A curve as samples in ascending strain, and what is computed from it before any model is fitted.

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace mpm::analysis {

/// Strain ascending; stress in Pa.
struct SampledCurve {
  std::vector<double> strain;
  std::vector<double> stress;
};

/// A stretch of a curve, by strain alone: choosing noisy samples by stress biases every fit.
struct Stretch {
  std::span<const double> strain;
  std::span<const double> stress;
};
Stretch between(const SampledCurve& curve, double from, double to);

/// The finite samples from `from` on up to the largest strain, later unloading left out.
SampledCurve loading_part(std::span<const double> strain, std::span<const double> stress,
                          double from);

/// Means of strain and stress in equal intervals of [0, end]; empty intervals are left out.
SampledCurve bin_average(const SampledCurve& curve, double end, int bins);

/// Slope of the straight line through the samples within +-reach, at every sample.
std::vector<double> local_slope(const SampledCurve& curve, double reach);

/// Curves that differ from a given one as another run's noise would: the difference from the
/// smoothed curve, rearranged in blocks of one ringing period, each taken from nearby strains since
/// the ringing is not the same everywhere.
class BlockBootstrap {
 public:
  BlockBootstrap(const SampledCurve& curve, double block_strain);
  SampledCurve resample();  ///< the same sequence in every program and on every machine

 private:
  const SampledCurve* curve_;
  std::vector<double> smooth_;
  std::vector<double> residual_;
  std::vector<std::size_t> block_begins_;  ///< and the end of the last
  std::mt19937_64 generator_{20061};
};

}  // namespace mpm::analysis
