#include <mpm/conditions/smooth_start.hpp>
#include <mpm/conditions/wall_motion.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Area under a table of velocities, from any time before the first of its own on.
double way_along(const std::vector<WallMotion::Entry>& table, double time)
{
  double way = table.front().velocity * std::min(time, table.front().time);
  for (std::size_t k = 1; k < table.size() && table[k - 1].time < time; ++k) {
    const auto [t0, v0] = table[k - 1];
    const auto [t1, v1] = table[k];
    const double t = std::min(time, t1);
    const double v = v0 + (v1 - v0) * (t - t0) / (t1 - t0);
    way += 0.5 * (v0 + v) * (t - t0);
  }
  return way + table.back().velocity * std::max(0.0, time - table.back().time);
}

}  // namespace

double WallMotion::velocity(double time) const
{
  if (!table.empty()) {
    const auto after =
        std::ranges::upper_bound(table, time, {}, [](const Entry& entry) { return entry.time; });
    if (after == table.begin()) return after->velocity;
    const Entry& a = *(after - 1);
    if (after == table.end()) return a.velocity;
    return a.velocity + (after->velocity - a.velocity) * (time - a.time) / (after->time - a.time);
  }
  return smooth_start(speed, time, ramp_time);
}

double WallMotion::displacement(double time) const
{
  if (!table.empty()) return way_along(table, time) - way_along(table, 0);
  if (time >= ramp_time) return speed * (time - 0.5 * ramp_time);
  const double s = std::max(0.0, time / ramp_time);
  return speed * ramp_time * s * s * s * (1 - 0.5 * s);
}

double WallMotion::largest_speed() const
{
  double largest = table.empty() ? std::abs(speed) : 0.0;
  for (const Entry& entry : table) largest = std::max(largest, std::abs(entry.velocity));
  return largest;
}

double WallMotion::time_of(double length) const
{
  const double time = length / speed + 0.5 * ramp_time;
  if (time >= ramp_time) return time;
  double lower = 0, upper = ramp_time;  // still in the smooth start: bisection
  while (upper - lower > 1e-15 * ramp_time) {
    const double middle = 0.5 * (lower + upper);
    (displacement(middle) / length < 1 ? lower : upper) = middle;
  }
  return upper;
}

}  // namespace mpm
