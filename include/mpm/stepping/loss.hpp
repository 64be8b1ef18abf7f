#pragma once
/// How a run ends at a particle.

#include <mpm/grid/grid_geometry.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/transfer/transfer.hpp>

#include <optional>
#include <string>

namespace mpm {

/// The step that is being done, counted from 1, and its start.
struct Moment {
  GlobalIndex step;
  double time;  ///< s
};

/// The first particle of a rank that was lost, and when.
template <int Dim>
struct Loss {
  LostParticle<Dim> particle;
  std::string body;
  Moment moment;
};

/// Throws NumericalError on every rank, in the words of the lowest one whose loss was in step
/// `first`. Collective.
template <int Dim>
[[noreturn]] void stop_at(GlobalIndex first, const std::optional<Loss<Dim>>& loss, MPI_Comm comm,
                          const GridGeometry<Dim>& geometry);

}  // namespace mpm
