#pragma once
/// Straight lines through sampled curves, and the knee between two of them.

#include <optional>
#include <span>

namespace mpm::analysis {

struct Line {
  double intercept = 0;
  double slope = 0;
  double operator()(double x) const { return intercept + slope * x; }
};

/// Least squares. Nothing if the points do not span an x interval.
std::optional<Line> fit_line(std::span<const double> x, std::span<const double> y);

/// The same with an oscillation of that period fitted along, so that a window of few periods does
/// not take a part of the ringing for slope. A plain line if the window is shorter than one period.
std::optional<Line> fit_line_under_ringing(std::span<const double> x, std::span<const double> y,
                                           double period);

/// The x where the lines meet; nothing if they are parallel.
std::optional<double> meeting_point(const Line& a, const Line& b);

/// Two lines that meet at x = position, fitted together.
struct Knee {
  double position = 0;
  double slope_before = 0;
  double slope_after = 0;
  double gain = 0;  ///< by which fraction the squared residual is below that of one straight line
};

/// The continuous pair of lines with the least squared residual, knee in [from, to].
/// X ascending. Nothing if no knee leaves enough points on both sides.
std::optional<Knee> fit_knee(std::span<const double> x, std::span<const double> y, double from,
                             double to);

}  // namespace mpm::analysis
