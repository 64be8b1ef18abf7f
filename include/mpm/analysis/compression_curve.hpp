#pragma once
/// Modulus, onset of buckling and onset of densification read off a compression curve.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpm::analysis {

/// Stress in Pa, strain as a fraction, both positive in compression.
struct CurvePoint {
  double strain;
  double stress;
  double strain_error = 0;  ///< two standard deviations over bootstrap resamples
  double stress_error = 0;
};

/// Where a soft start gives way to a steeper line: what is read off a test after toe compensation
/// (ASTM D695, annex A1), with strains from where that line is free of stress.
struct Toe {
  double strain;   ///< at which the steep line would have no stress
  double modulus;  ///< Pa, of the steep line
};

struct CompressionProperties {
  std::optional<double> modulus;  ///< Pa, slope of the linear part; line not forced through 0
  double modulus_error = 0;       ///< as of points; resamples differ in the window of the line, too
  double elastic_intercept = 0;   ///< Pa, of that line at zero strain
  std::optional<Toe> toe;         ///< of a curve that has one; strains of the onsets hold it
  std::optional<CurvePoint> buckling;
  std::optional<CurvePoint> densification;
  std::optional<double> plateau_slope;          ///< Pa, of the line through both onsets
  std::optional<double> densification_slope;    ///< Pa, of the line that rises from the second
  std::optional<CurvePoint> energy_efficiency;  ///< its strain maximises (1/stress) int stress
  std::string remark;                           ///< why something is missing; empty if nothing is
};

struct CurveOptions {
  double discard_strain = 0;      ///< start-up transient, 2 V/c_p
  double ringing_strain = 0.004;  ///< strain of one ringing period: block of the bootstrap
  /// The line of densification goes through the points at so many times the plateau's last stress.
  double densification_from = 2;
  double densification_to = 4;  ///< above `densification_from`, which is above 1
  int resamples = 50;
};

/// Strains at which the lines of a run's history count, whose stresses are means since the line
/// before: the middle between both, and the first line's own.
std::vector<double> middle_strains(std::span<const double> strain);

/// Any sampling; the same result for the same input everywhere (fixed seed).
CompressionProperties compression_properties(std::span<const double> strain,
                                             std::span<const double> stress,
                                             const CurveOptions& options);

}  // namespace mpm::analysis
