#include <mpm/analysis/straight_line.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace mpm::analysis {

namespace {

constexpr int knee_positions = 350;  ///< steps of 0.025 % strain over the usual range
constexpr std::ptrdiff_t points_of_a_side = 4;
constexpr std::size_t fewest_for_ringing = 12;  ///< three points for each of four coefficients

double mean(std::span<const double> values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double squared_residual(std::span<const double> x, std::span<const double> y, const Line& line)
{
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (y[i] - line(x[i])) * (y[i] - line(x[i]));
  return sum;
}

/// Basis 1, min(x, k) - k, max(x, k) - k: the coefficients of the last two are the slopes.
struct PairOfLines {
  Eigen::Vector3d coefficients;
  double squared_residual = 0;
};

PairOfLines fit_pair(std::span<const double> x, std::span<const double> y, double knee)
{
  const auto basis = [knee](double at) {
    return Eigen::Vector3d(1, std::min(at, knee) - knee, std::max(at, knee) - knee);
  };
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d row = basis(x[i]);
    normal += row * row.transpose();
    right += row * y[i];
  }
  PairOfLines pair{normal.ldlt().solve(right), 0};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double difference = y[i] - pair.coefficients.dot(basis(x[i]));
    pair.squared_residual += difference * difference;
  }
  return pair;
}

}  // namespace

std::optional<Line> fit_line(std::span<const double> x, std::span<const double> y)
{
  if (x.size() < 2) return std::nullopt;
  const double x_mean = mean(x);
  const double y_mean = mean(y);
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  if (!(xx > 0)) return std::nullopt;
  const double slope = xy / xx;
  return Line{y_mean - slope * x_mean, slope};
}

std::optional<Line> fit_line_under_ringing(std::span<const double> x, std::span<const double> y,
                                           double period)
{
  if (x.size() < fewest_for_ringing || x.back() - x.front() < period) return fit_line(x, y);
  const double origin = x.front();
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double phase = 2 * std::numbers::pi * (x[i] - origin) / period;
    const Eigen::Vector4d row(1, (x[i] - origin) / period, std::sin(phase), std::cos(phase));
    normal += row * row.transpose();
    right += row * y[i];
  }
  const Eigen::Vector4d solution = normal.ldlt().solve(right);
  const double slope = solution[1] / period;
  return Line{solution[0] - slope * origin, slope};
}

std::optional<double> meeting_point(const Line& a, const Line& b)
{
  if (a.slope == b.slope) return std::nullopt;
  return (b.intercept - a.intercept) / (a.slope - b.slope);
}

std::optional<Knee> fit_knee(std::span<const double> x, std::span<const double> y, double from,
                             double to)
{
  const std::optional<Line> single = fit_line(x, y);
  if (!single) return std::nullopt;
  const double without_knee = squared_residual(x, y, *single);

  std::optional<Knee> best;
  for (int step = 0; step <= knee_positions; ++step) {
    const double position = from + (to - from) * step / knee_positions;
    const auto first_after = std::upper_bound(x.begin(), x.end(), position);
    if (first_after - x.begin() < points_of_a_side || x.end() - first_after < points_of_a_side)
      continue;
    const PairOfLines pair = fit_pair(x, y, position);
    const double gain = without_knee > 0 ? 1 - pair.squared_residual / without_knee : 0;
    if (!best || gain > best->gain)
      best = Knee{position, pair.coefficients[1], pair.coefficients[2], gain};
  }
  return best;
}

}  // namespace mpm::analysis
