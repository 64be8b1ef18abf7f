#pragma once
/// What the steps of a scene take on the machine that asks, and what its files will.

#include <mpm/simulation/preparation.hpp>

#include <string>

namespace mpm {

struct StepMeasurement {
  GlobalIndex steps = 0;                            ///< measured
  std::string why_none{};                           ///< in words, where there are none
  double seconds = 0;                               ///< of one step
  double snapshot_bytes = 0, checkpoint_bytes = 0;  ///< of one, before any compression
};

/// Steps the scene from its start for about so many seconds, and at least once, as a run would,
/// with its history and without files; not where this would take more than half of the memory of a
/// node. Collective.
template <int Dim>
StepMeasurement measure_steps(const Preparation<Dim>& preparation, double seconds);

}  // namespace mpm
