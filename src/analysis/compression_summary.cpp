#include <mpm/analysis/compression_summary.hpp>

namespace mpm::analysis {

namespace {

void describe_point(const std::optional<CurvePoint>& point, const std::string& key,
                    output::Summary& section)
{
  if (!point) {
    section.set(key, std::optional<double>());
    return;
  }
  output::Summary& place = section.section(key);
  place.set("strain", point->strain);
  place.set("strain_error", point->strain_error);
  place.set("stress", point->stress);
  place.set("stress_error", point->stress_error);
}

}  // namespace

void describe(const CompressionProperties& properties, output::Summary& section)
{
  section.set("modulus", properties.modulus);
  section.set("modulus_error", properties.modulus_error);
  section.set("elastic_intercept", properties.elastic_intercept);
  if (properties.toe) {
    output::Summary& toe = section.section("toe");
    toe.set("strain", properties.toe->strain);
    toe.set("modulus", properties.toe->modulus);
  } else {
    section.set("toe", std::optional<double>());
  }
  describe_point(properties.buckling, "buckling", section);
  describe_point(properties.densification, "densification", section);
  section.set("plateau_slope", properties.plateau_slope);
  section.set("densification_slope", properties.densification_slope);
  describe_point(properties.energy_efficiency, "energy_efficiency", section);
  section.set("remark", properties.remark);
}

}  // namespace mpm::analysis
