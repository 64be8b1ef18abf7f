#pragma once
/// What ends a run at a particle: it went astray, or a step turned it inside out. What a law makes
/// of b = f b f^T after such a step looks sound and means nothing.

#include <mpm/transfer/transfer.hpp>

#include <cmath>

namespace mpm {

/// det(I / dt + L) of one block from its velocity gradients L, dv_i/dx_j at i + Dim * j, 1/s, and
/// the rate 1 / dt: det(I + dt L) over dt^Dim, with fewer products.
template <int Dim>
[[gnu::always_inline]] inline Lanes step_determinant(const double* gradient, double rate)
{
  const auto f = [&](int i, int j) {
    const Lanes component = load(gradient + (i + Dim * j) * lane_count);
    return i == j ? rate + component : component;
  };
  if constexpr (Dim == 2)
    return f(0, 0) * f(1, 1) - f(0, 1) * f(1, 0);
  else
    return f(0, 0) * (f(1, 1) * f(2, 2) - f(1, 2) * f(2, 1)) -
           f(0, 1) * (f(1, 0) * f(2, 2) - f(1, 2) * f(2, 0)) +
           f(0, 2) * (f(1, 0) * f(2, 1) - f(1, 1) * f(2, 0));
}

/// Notes the first particle of the block whose `step_determinant` is not positive.
template <int Dim>
[[gnu::noinline]] void report_inverted(const ParticleStore& particles, LocalIndex block,
                                       Lanes determinant, double dt, PassOutcome<Dim>& outcome)
{
  for (int lane = 0; lane < lane_count; ++lane) {
    const LocalIndex particle = block * lane_count + lane;
    if (determinant[lane] > 0 || outcome.lost || particle >= particles.size()) continue;
    outcome.lost = lost_particle<Dim>(particles, particle);
    outcome.lost->fault = Fault::inverted;
    outcome.lost->ratio = determinant[lane] * std::pow(dt, Dim);
  }
}

/// Notes the first lost particle and puts all lost ones where memory is valid; the run ends
/// soon after.
template <int Dim>
void report_lost(const ParticleStore& particles, LocalIndex block, const LaneMask& reach,
                 const Lanes (&v)[Dim], const MoveBounds<Dim>& bounds, Lanes (&x)[Dim],
                 PassOutcome<Dim>& outcome)
{
  for (int lane = 0; lane < lane_count; ++lane) {
    if (reach[lane]) continue;
    const LocalIndex particle = block * lane_count + lane;
    if (!outcome.lost && particle < particles.size()) {
      outcome.lost.emplace();
      outcome.lost->id = particles.ids()[particle];
      for (int d = 0; d < Dim; ++d) {
        outcome.lost->position[d] = x[d][lane];
        outcome.lost->velocity[d] = v[d][lane];
      }
    }
    for (int d = 0; d < Dim; ++d)
      x[d][lane] = 0.5 * (bounds.reach_lower[d] + bounds.reach_upper[d]);
  }
}

}  // namespace mpm
