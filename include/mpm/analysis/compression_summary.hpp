#pragma once
/// The properties of a compression curve as a part of summary.json.

#include <mpm/analysis/compression_curve.hpp>
#include <mpm/output/summary.hpp>

namespace mpm::analysis {

/// SI units, strain as a fraction; what was not found is null, the remark says why.
void describe(const CompressionProperties& properties, output::Summary& section);

}  // namespace mpm::analysis
