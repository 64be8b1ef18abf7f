#include <mpm/core/error.hpp>
#include <mpm/micrograph/threshold.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpm::micrograph {

double otsu_threshold(std::span<const double> gray)
{
  std::array<double, 256> count{};
  double total = 0, total_level = 0;
  for (const double level : gray) {
    const auto bin = std::size_t(std::clamp(std::lround(level), 0L, 255L));
    count[bin] += 1;
    total += 1;
    total_level += double(bin);
  }

  double best = 0, below = 0, below_level = 0;
  std::size_t first = 0, last = 0;  // thresholds that are equally good
  for (std::size_t threshold = 1; threshold < count.size(); ++threshold) {
    below += count[threshold - 1];
    below_level += count[threshold - 1] * double(threshold - 1);
    const double above = total - below;
    if (below == 0 || above == 0) continue;
    const double difference = below_level / below - (total_level - below_level) / above;
    const double between = below * above * difference * difference;
    if (between > best) {
      best = between;
      first = last = threshold;
    } else if (between == best && count[threshold - 1] == 0 && threshold == last + 1) {
      last = threshold;
    }
  }
  if (best == 0)
    throw InputError(
        "specimen.threshold is otsu, but the image has a single gray level. Check the image and "
        "the "
        "crop.");
  return double((first + last) / 2);
}

double threshold_for_density(std::span<const double> means, double target, scene::Wall wall)
{
  if (!(target > 0 && target < 1))
    throw InputError(fmt::format(
        "specimen.target_relative_density is {} (must lie between 0 and 1, both excluded).",
        target));
  const double wanted_below =
      double(means.size()) * (wall == scene::Wall::bright ? 1 - target : target);
  std::vector<double> sorted(means.begin(), means.end());
  const auto pivot =
      sorted.begin() + std::min(std::ptrdiff_t(wanted_below), std::ptrdiff_t(sorted.size()) - 1);
  std::nth_element(sorted.begin(), pivot, sorted.end());
  const double level = *pivot;

  // A threshold can pass below or above all the means that equal `level`.
  double next_below = -std::numeric_limits<double>::infinity(), next_above = -next_below;
  double count_below = 0, count_up_to = 0;
  for (const double mean : sorted) {
    count_below += mean < level;
    count_up_to += mean <= level;
    if (mean < level) next_below = std::max(next_below, mean);
    if (mean > level) next_above = std::min(next_above, mean);
  }
  const bool pass_below = wanted_below - count_below <= count_up_to - wanted_below;
  const double lower = pass_below ? next_below : level;
  const double upper = pass_below ? level : next_above;
  if (std::isinf(lower)) return upper;
  if (std::isinf(upper)) return std::nextafter(lower, upper);
  const double middle = lower + 0.5 * (upper - lower);
  return middle > lower ? middle : upper;  // neighbouring numbers have no middle
}

}  // namespace mpm::micrograph
