#include <mpm/analysis/compression_curve.hpp>
#include <mpm/analysis/sampled_curve.hpp>
#include <mpm/analysis/straight_line.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/core.h>

namespace mpm::analysis {

namespace {

// The knee is looked for in strains up to 12 %: no wood model's plateau ends before.
constexpr double knee_range = 0.12;
constexpr int knee_bins = 240;
constexpr double smallest_knee = 0.003;
constexpr double largest_knee = 0.09;
constexpr double significant_gain = 0.2;
/// A plateau is clearly less steep than the elastic line. Wood loaded along its rays hardens as it
/// collapses: drawn poplar in tangential compression keeps 0.6 of its first slope.
constexpr double softening = 0.7;
/// A toe is clearly less steep than what follows, and low beside it: half of the knee's stress.
constexpr double stiffening = 1.5;
constexpr double low_toe = 0.5;
constexpr double toe_reach = 0.005;
/// What is shorter than that may be a start-up, or some periods of ringing.
constexpr double smallest_toe = 0.01;
constexpr double ringing_of_toe = 2.5;
constexpr int curve_bins = 400;
constexpr double tangent_reach = 0.03;
constexpr double before_knee = 0.5;
constexpr std::size_t fewest_points = 12;

void add_remark(std::string& remark, const std::string& text)
{
  if (!remark.empty()) remark += ' ';
  remark += text;
}

std::optional<Line> fit_between(const SampledCurve& curve, double from, double to,
                                std::size_t at_least)
{
  const Stretch part = between(curve, from, to);
  if (part.strain.size() < at_least) return std::nullopt;
  return fit_line(part.strain, part.stress);
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A curve that bends has another modulus in a longer or shorter window: resamples have windows of
/// up to that many times the length, and down to one part of so many.
constexpr double window_range = 1.5;

/// From 0.1 to 0.45 of the knee strain; the start-up transient moves the window up, not past 0.8.
struct Window {
  double from;
  double to;
};
/// `share`: of that length.
Window elastic_window(double knee, double discard, double share)
{
  const double from = std::max(0.10 * knee, discard);
  const double to =
      std::max((0.10 + 0.35 * share) * knee, std::min(from + 0.35 * share * knee, 0.8 * knee));
  return {from, to};
}

std::optional<Line> fit_elastic(const SampledCurve& curve, const Window& window, double ringing)
{
  const Stretch part = between(curve, window.from, window.to);
  if (part.strain.size() < 5) return std::nullopt;
  return fit_line_under_ringing(part.strain, part.stress, ringing);
}

std::optional<Knee> softening_knee(const SampledCurve& fine, double begin, double end)
{
  const Stretch part = between(fine, begin, knee_range);
  const std::optional<Knee> knee =
      fit_knee(part.strain, part.stress, begin + smallest_knee, std::min(largest_knee, end));
  if (!knee || knee->gain < significant_gain || knee->slope_before <= 0 ||
      knee->slope_after > softening * knee->slope_before)
    return std::nullopt;
  return knee;
}

/// To where the line before the knee reaches.
double reach_of_line(const std::optional<Knee>& knee, double end)
{
  return knee ? knee->position : std::min(end, knee_range);
}

/// A first, soft part of the curve: slots across the whole specimen that close first (lumens of
/// rays in tangential compression), or uneven faces in a test.
struct SoftStart {
  double end;                ///< strain
  std::optional<Knee> knee;  ///< where the steep part after it ends
  Line line;                 ///< of the steep part
};

std::optional<SoftStart> find_soft_start(const SampledCurve& curve, const SampledCurve& fine,
                                         double end, double ringing)
{
  const std::vector<double> tangent = local_slope(fine, toe_reach);
  const auto range = std::upper_bound(fine.strain.begin(), fine.strain.end(), largest_knee);
  const auto steepest =
      std::max_element(tangent.begin(), tangent.begin() + (range - fine.strain.begin()));
  const double steepest_at = fine.strain[std::size_t(steepest - tangent.begin())];
  const double least = std::max(smallest_toe, ringing_of_toe * ringing);
  if (steepest_at <= least) return std::nullopt;
  const Stretch start = between(fine, 0, steepest_at + toe_reach);
  const std::optional<Knee> toe = fit_knee(start.strain, start.stress, least, steepest_at);
  if (!toe || toe->gain < significant_gain || toe->slope_before <= 0 ||
      toe->slope_after < stiffening * toe->slope_before)
    return std::nullopt;

  const double from = toe->position;
  const std::optional<Knee> knee = softening_knee(fine, from, end);
  const double length = reach_of_line(knee, end) - from;
  const std::optional<Line> line =
      fit_between(curve, from + 0.25 * length, from + 0.75 * length, 5);
  if (!line || line->slope < stiffening * toe->slope_before ||
      toe->slope_before * from > low_toe * (*line)(from + length))
    return std::nullopt;
  return SoftStart{from, knee, *line};
}

/// The straight part after the knee; its end is where the tangent starts to rise for good.
struct Plateau {
  Line line;
  std::optional<double> end;
};

struct PlateauSearch {
  double scale;       ///< of all lengths, which are those of wood's usual plateau of 10 % and more
  bool beyond_peaks;  ///< a rise that ends below what was borne before is a peak's swing back
};
constexpr PlateauSearch usual_plateau{1, true};
/// Elastic walls on a coarse grid meet within 5 % strain of their buckling.
constexpr PlateauSearch short_plateau{1.0 / 3, false};

/// Strain beyond `from` where the tangent becomes steep.
std::optional<double> begin_of_rise(const SampledCurve& binned, const std::vector<double>& tangent,
                                    double from, double steep, bool beyond_peaks)
{
  double highest = 0;
  std::optional<double> begin;
  for (std::size_t i = 0; i < tangent.size(); ++i) {
    const bool rises = binned.strain[i] > from && tangent[i] > steep;
    if (!rises)
      begin.reset();
    else if (!begin)
      begin = binned.strain[i];
    if (begin && (!beyond_peaks || binned.stress[i] > highest)) return begin;
    highest = std::max(highest, binned.stress[i]);
  }
  return begin;
}

std::optional<Plateau> find_plateau(const SampledCurve& binned, double knee, double modulus,
                                    const PlateauSearch& search)
{
  const double scale = search.scale;
  const std::vector<double> tangent = local_slope(binned, tangent_reach * scale);
  std::vector<double> on_plateau;
  for (std::size_t i = 0; i < tangent.size(); ++i)
    if (binned.strain[i] > knee + 0.02 * scale && binned.strain[i] < knee + 0.12 * scale)
      on_plateau.push_back(tangent[i]);
  if (on_plateau.empty()) return std::nullopt;
  const double base = median(on_plateau);
  const double steep = std::max(2.5 * base, base + 0.03 * modulus);

  Plateau plateau;
  plateau.end = begin_of_rise(binned, tangent, knee + 0.05 * scale, steep, search.beyond_peaks);
  const double to = plateau.end ? *plateau.end - 0.03 * scale : binned.strain.back();
  if (to < knee + 0.04 * scale) return std::nullopt;
  const std::optional<Line> line = fit_between(binned, knee + 0.02 * scale, to, 5);
  if (!line) return std::nullopt;
  plateau.line = *line;
  return plateau;
}

/// Through the strains at which the curve first reaches the two multiples of the plateau's last
/// stress.
std::optional<Line> densification_line(const SampledCurve& binned, double plateau_end,
                                       const CurveOptions& options)
{
  const auto reaches = [&](double from, double stress) -> std::optional<double> {
    for (std::size_t i = 0; i < binned.strain.size(); ++i)
      if (binned.strain[i] >= from && binned.stress[i] >= stress) return binned.strain[i];
    return std::nullopt;
  };
  const Stretch rest = between(binned, plateau_end, binned.strain.back());
  if (rest.stress.empty() || rest.stress.front() <= 0) return std::nullopt;
  const double last = rest.stress.front();
  const std::optional<double> from = reaches(plateau_end, options.densification_from * last);
  const std::optional<double> to = reaches(plateau_end, options.densification_to * last);
  if (!from || !to) return std::nullopt;
  return fit_between(binned, *from, *to, 2);
}

std::optional<CurvePoint> meeting(const Line& a, const Line& b)
{
  const std::optional<double> strain = meeting_point(a, b);
  if (!strain || *strain <= 0) return std::nullopt;
  return CurvePoint{*strain, b(*strain)};
}

/// What was taken for the plateau may be the rise that follows a short one: its line meets the
/// elastic one far before the knee, or nowhere. A short one that falls is what follows a peak.
std::optional<Plateau> find_plateau(const SampledCurve& binned, double knee, const Line& rise)
{
  const std::optional<Plateau> usual = find_plateau(binned, knee, rise.slope, usual_plateau);
  if (!usual) return usual;
  const std::optional<CurvePoint> point = meeting(rise, usual->line);
  if (point && point->strain > before_knee * knee) return usual;
  const std::optional<Plateau> brief = find_plateau(binned, knee, rise.slope, short_plateau);
  return brief && brief->line.slope < 0 ? usual : brief;
}

/// Li, Magkiriadis & Harrigan 2006, J. Cell. Plast. 42:371: the strain up to which most energy is
/// taken up per stress. Nothing if the efficiency still rises at the end of the curve.
std::optional<CurvePoint> most_efficient(const SampledCurve& binned, double after)
{
  double energy = 0;
  double last_strain = 0;
  double last_stress = 0;
  double best = 0;
  std::optional<CurvePoint> point;
  for (std::size_t i = 0; i < binned.strain.size(); ++i) {
    const double strain = binned.strain[i];
    const double stress = binned.stress[i];
    energy += 0.5 * (stress + last_stress) * (strain - last_strain);
    last_strain = strain;
    last_stress = stress;
    if (strain <= after || stress <= 0 || energy / stress <= best) continue;
    best = energy / stress;
    point = CurvePoint{strain, stress};
  }
  if (point && point->strain > 0.97 * last_strain) return std::nullopt;
  return point;
}

CompressionProperties read_off(const SampledCurve& curve, const CurveOptions& options,
                               double window_share)
{
  CompressionProperties found;
  const double end = curve.strain.empty() ? 0 : curve.strain.back();
  const SampledCurve fine = bin_average(curve, knee_range, knee_bins);
  if (curve.strain.size() < fewest_points || fine.strain.size() < fewest_points) {
    add_remark(found.remark, fmt::format("Too few points: {} up to {:.3g} % strain.",
                                         curve.strain.size(), 100 * end));
    return found;
  }
  const auto [lowest, highest] = std::minmax_element(curve.stress.begin(), curve.stress.end());
  if (*lowest == *highest) {
    add_remark(found.remark, "The stress is the same everywhere.");
    return found;
  }

  const std::optional<SoftStart> soft_start =
      find_soft_start(curve, fine, end, options.ringing_strain);
  const std::optional<Knee> knee = soft_start ? soft_start->knee : softening_knee(fine, 0, end);
  const Window window = elastic_window(soft_start ? soft_start->end : reach_of_line(knee, end),
                                       options.discard_strain, window_share);
  const std::optional<Line> elastic = fit_elastic(curve, window, options.ringing_strain);
  if (elastic && elastic->slope > 0) {
    found.modulus = elastic->slope;
    found.elastic_intercept = elastic->intercept;
  } else {
    add_remark(found.remark,
               fmt::format("No modulus: no rising line between {:.2g} and {:.2g} % strain.",
                           100 * window.from, 100 * window.to));
  }
  if (soft_start)
    found.toe = Toe{-soft_start->line.intercept / soft_start->line.slope, soft_start->line.slope};
  if (!knee) {
    add_remark(found.remark, "No onset of buckling: no knee in the first 12 % strain.");
    return found;
  }

  const SampledCurve binned = bin_average(curve, end, curve_bins);
  found.energy_efficiency = most_efficient(binned, knee->position);
  if (!found.modulus) return found;
  const Line rise = soft_start ? soft_start->line : *elastic;
  const std::optional<Plateau> plateau = find_plateau(binned, knee->position, rise);
  if (plateau) {
    found.plateau_slope = plateau->line.slope;
    found.buckling = meeting(rise, plateau->line);
  }
  if (!found.buckling) {
    add_remark(found.remark, "No onset of buckling: the curve ends before a plateau.");
    return found;
  }
  if (found.buckling->strain > knee_range) {
    found.buckling.reset();
    add_remark(
        found.remark,
        "No onset of buckling: the lines before and after the knee meet beyond 12 % strain.");
    return found;
  }
  if (const std::optional<Line> dense =
          plateau->end ? densification_line(binned, *plateau->end, options) : std::nullopt) {
    found.densification_slope = dense->slope;
    found.densification = meeting(*dense, plateau->line);
  }
  if (!found.densification)
    add_remark(found.remark,
               fmt::format("No onset of densification: the curve ends below {:g} times the "
                           "plateau's stress.",
                           options.densification_to));
  return found;
}

/// Two standard deviations of what the resamples gave.
class Spread {
 public:
  void add(double value)
  {
    ++count_;
    const double difference = value - mean_;
    mean_ += difference / count_;
    squares_ += difference * (value - mean_);
  }
  double error() const { return count_ < 2 ? 0 : 2 * std::sqrt(squares_ / (count_ - 1)); }

 private:
  int count_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

struct PointSpread {
  Spread strain;
  Spread stress;
  void add(const std::optional<CurvePoint>& point)
  {
    if (!point) return;
    strain.add(point->strain);
    stress.add(point->stress);
  }
  void report(std::optional<CurvePoint>& point) const
  {
    if (!point) return;
    point->strain_error = strain.error();
    point->stress_error = stress.error();
  }
};

}  // namespace

std::vector<double> middle_strains(std::span<const double> strain)
{
  std::vector<double> middles;
  for (std::size_t i = 0; i < strain.size(); ++i)
    middles.push_back(i == 0 ? strain[i] : 0.5 * (strain[i - 1] + strain[i]));
  return middles;
}

CompressionProperties compression_properties(std::span<const double> strain,
                                             std::span<const double> stress,
                                             const CurveOptions& options)
{
  const SampledCurve curve = loading_part(strain, stress, options.discard_strain);
  CompressionProperties found = read_off(curve, options, 1);
  if (!found.modulus) return found;

  Spread modulus;
  PointSpread buckling;
  PointSpread densification;
  PointSpread energy_efficiency;
  BlockBootstrap bootstrap(curve, options.ringing_strain);
  for (int i = 0; i < options.resamples; ++i) {
    const double share = std::pow(window_range, (2.0 * i + 1) / options.resamples - 1);
    const CompressionProperties again = read_off(bootstrap.resample(), options, share);
    if (again.modulus) modulus.add(*again.modulus);
    buckling.add(again.buckling);
    densification.add(again.densification);
    energy_efficiency.add(again.energy_efficiency);
  }
  found.modulus_error = modulus.error();
  buckling.report(found.buckling);
  densification.report(found.densification);
  energy_efficiency.report(found.energy_efficiency);
  return found;
}

}  // namespace mpm::analysis
