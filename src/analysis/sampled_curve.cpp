#include <mpm/analysis/sampled_curve.hpp>
#include <mpm/analysis/straight_line.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mpm::analysis {

namespace {

/// For every sample the index range of the samples within +-reach of it.
struct Neighbours {
  std::size_t begin;
  std::size_t count;
};
std::vector<Neighbours> neighbours(const std::vector<double>& x, double reach)
{
  std::vector<Neighbours> ranges;
  ranges.reserve(x.size());
  std::size_t begin = 0;
  std::size_t end = 0;
  for (const double centre : x) {
    while (x[begin] < centre - reach) ++begin;
    while (end < x.size() && x[end] <= centre + reach) ++end;
    ranges.push_back({begin, end - begin});
  }
  return ranges;
}

/// The value at `centre` of the least-squares parabola: it follows a rounded corner, a line does
/// not.
double parabola_at(double centre, double reach, std::span<const double> x,
                   std::span<const double> y)
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double t = (x[i] - centre) / reach;
    const Eigen::Vector3d row(1, t, t * t);
    normal += row * row.transpose();
    right += row * y[i];
  }
  return normal.ldlt().solve(right)[0];
}

}  // namespace

Stretch between(const SampledCurve& curve, double from, double to)
{
  const auto begin = std::lower_bound(curve.strain.begin(), curve.strain.end(), from);
  const auto end = std::upper_bound(begin, curve.strain.end(), std::max(from, to));
  const std::size_t first = std::size_t(begin - curve.strain.begin());
  const std::size_t count = std::size_t(end - begin);
  return {std::span(curve.strain).subspan(first, count),
          std::span(curve.stress).subspan(first, count)};
}

SampledCurve loading_part(std::span<const double> strain, std::span<const double> stress,
                          double from)
{
  std::vector<std::size_t> kept;
  std::size_t kept_to_largest = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(strain.size(), stress.size()); ++i) {
    if (!std::isfinite(strain[i]) || !std::isfinite(stress[i]) || strain[i] < from) continue;
    kept.push_back(i);
    if (strain[i] > largest) {
      largest = strain[i];
      kept_to_largest = kept.size();
    }
  }
  kept.resize(kept_to_largest);
  std::stable_sort(kept.begin(), kept.end(),
                   [&](std::size_t a, std::size_t b) { return strain[a] < strain[b]; });
  SampledCurve curve;
  for (const std::size_t i : kept) {
    curve.strain.push_back(strain[i]);
    curve.stress.push_back(stress[i]);
  }
  return curve;
}

SampledCurve bin_average(const SampledCurve& curve, double end, int bins)
{
  SampledCurve averaged;
  std::size_t i = 0;
  while (i < curve.strain.size() && curve.strain[i] < 0) ++i;
  for (int bin = 0; bin < bins; ++bin) {
    const double upper = end * (bin + 1) / bins;
    double strain = 0;
    double stress = 0;
    int count = 0;
    for (; i < curve.strain.size() && curve.strain[i] <= upper; ++i, ++count) {
      strain += curve.strain[i];
      stress += curve.stress[i];
    }
    if (count == 0) continue;
    averaged.strain.push_back(strain / count);
    averaged.stress.push_back(stress / count);
  }
  return averaged;
}

std::vector<double> local_slope(const SampledCurve& curve, double reach)
{
  std::vector<double> slopes;
  for (const auto [begin, count] : neighbours(curve.strain, reach)) {
    const std::optional<Line> line = fit_line(std::span(curve.strain).subspan(begin, count),
                                              std::span(curve.stress).subspan(begin, count));
    slopes.push_back(line ? line->slope : 0);
  }
  return slopes;
}

BlockBootstrap::BlockBootstrap(const SampledCurve& curve, double block_strain) : curve_(&curve)
{
  constexpr std::size_t fewest = 5;  // below, a parabola goes through the points themselves
  // One period to either side averages the ringing out and keeps the shape.
  const std::vector<Neighbours> ranges = neighbours(curve.strain, block_strain);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto [begin, count] = ranges[i];
    smooth_.push_back(count < fewest ? curve.stress[i]
                                     : parabola_at(curve.strain[i], block_strain,
                                                   std::span(curve.strain).subspan(begin, count),
                                                   std::span(curve.stress).subspan(begin, count)));
    residual_.push_back(curve.stress[i] - smooth_.back());
    const double since =
        block_begins_.empty() ? block_strain : curve.strain[i] - curve.strain[block_begins_.back()];
    if (since >= block_strain) block_begins_.push_back(i);
  }
  block_begins_.push_back(curve.strain.size());
}

SampledCurve BlockBootstrap::resample()
{
  constexpr std::size_t blocks_around = 3;
  SampledCurve drawn{curve_->strain, smooth_};
  const std::size_t blocks = block_begins_.size() - 1;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t lowest = block > blocks_around ? block - blocks_around : 0;
    const std::size_t highest = std::min(block + blocks_around, blocks - 1);
    // The standard's distributions may differ between libraries; the generator may not.
    const std::size_t source = lowest + std::size_t(generator_() % (highest - lowest + 1));
    const std::size_t length = block_begins_[block + 1] - block_begins_[block];
    const std::size_t source_length = block_begins_[source + 1] - block_begins_[source];
    for (std::size_t i = 0; i < length; ++i)
      drawn.stress[block_begins_[block] + i] +=
          residual_[block_begins_[source] + i * source_length / length];
  }
  return drawn;
}

}  // namespace mpm::analysis
