#pragma once
/// Everything that is known of a run before it starts.

#include <mpm/parallel/partition.hpp>
#include <mpm/simulation/layout.hpp>
#include <mpm/simulation/plan.hpp>

#include <string>
#include <vector>

namespace mpm {

template <int Dim>
struct Preparation {
  const scene::Scene& scene;
  micrograph::Specimen<Dim> specimen;
  Layout<Dim> layout;
  Partition<Dim> partition;  ///< of the particles at the start
  MPI_Comm comm;
  std::vector<std::string> warnings;
  Plan plan;

  /// Collective. Throws InputError on every rank.
  Preparation(MPI_Comm comm, const scene::Scene& scene, std::optional<micrograph::Picture> picture);

  /// The scene with the values that the program has chosen: it repeats the run exactly.
  scene::Scene effective_scene() const;
};

/// What the arrays of a run take of the memory of the machine that is filled most. Collective.
template <int Dim>
double share_of_memory(const Preparation<Dim>& preparation);

struct StepMeasurement;

/// What will run and what is left out; with a measurement, what it will take, too: the text of
/// --check.
template <int Dim>
std::string plan_text(const Preparation<Dim>& preparation, const StepMeasurement* measured);

/// How the scene would be shared out among each of these numbers of ranks: the text of
/// --check --ranks. Looks at all particles on the rank that asks.
template <int Dim>
std::string rank_study_text(const Preparation<Dim>& preparation, const std::vector<int>& ranks);

}  // namespace mpm
