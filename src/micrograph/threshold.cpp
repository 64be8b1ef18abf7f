#include <mpm/core/error.hpp>
#include <mpm/micrograph/threshold.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace mpm::micrograph {

double otsu_threshold(std::span<const double> gray)
{
  // Bins begin at the levels that thresholds may have, so that a threshold parts the pixels as it
  // was counted: whole ones of 8 bits where all grays are, of 16 bits otherwise.
  const bool whole = std::ranges::all_of(gray, [](double level) { return level == int(level); });
  const int bins_per_level = whole ? 1 : 257;
  std::vector<double> count(std::size_t(255 * bins_per_level + 1));
  double total = 0, total_level = 0;
  for (const double level : gray) {
    constexpr double rounding = 1e-6;  // of levels that are fractions of 257
    const auto bin = std::size_t(level * bins_per_level + rounding);
    count[std::min(bin, count.size() - 1)] += 1;
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
  return double((first + last) / 2) / bins_per_level;
}

double nth_smallest(std::span<const double> values, std::int64_t n, const Share& share)
{
  // Numbers that are not negative are ordered like their bits: from the highest byte on, count the
  // values that begin with the bytes found so far by their next byte.
  std::uint64_t found = 0;
  for (int shift = 56; shift >= 0; shift -= 8) {
    std::array<double, 256> count{};
    for (const double value : values) {
      const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);  // no minus before a zero
      const std::uint64_t differing = (bits ^ found) >> shift;
      if (differing < 256) count[(bits >> shift) & 255] += 1;
    }
    share.sum(count);
    std::size_t byte = 0;
    while (byte < 255 && double(n) >= count[byte]) n -= std::int64_t(count[byte++]);
    found |= std::uint64_t(byte) << shift;
  }
  return std::bit_cast<double>(found);
}

double level_with_share_below(std::span<const double> values, double share_below,
                              const Share& share)
{
  double total = double(values.size());
  share.sum(std::span(&total, 1));
  const double wanted_below = total * share_below;
  const double level =
      nth_smallest(values, std::min(std::int64_t(wanted_below), std::int64_t(total) - 1), share);

  // A threshold can pass below or above all the values that equal `level`.
  std::array<double, 2> count{};  // below, and up to it
  for (const double value : values) {
    count[0] += value < level;
    count[1] += value <= level;
  }
  share.sum(count);
  const bool pass_below = wanted_below - count[0] <= count[1] - wanted_below;
  if (pass_below && count[0] == 0) return level;
  if (!pass_below && count[1] == total)
    return std::nextafter(level, std::numeric_limits<double>::infinity());
  const double lower = pass_below ? nth_smallest(values, std::int64_t(count[0]) - 1, share) : level;
  const double upper = pass_below ? level : nth_smallest(values, std::int64_t(count[1]), share);
  const double middle = lower + 0.5 * (upper - lower);
  return middle > lower ? middle : upper;  // neighbouring numbers have no middle
}

double threshold_for_density(std::span<const double> means, double target, scene::Wall wall,
                             const Share& share)
{
  if (!(target > 0 && target < 1))
    throw InputError(fmt::format(
        "specimen.target_relative_density is {} (must lie between 0 and 1, both excluded).",
        target));
  return level_with_share_below(means, wall == scene::Wall::bright ? 1 - target : target, share);
}

}  // namespace mpm::micrograph
