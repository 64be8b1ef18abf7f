#pragma once
/// Energy that nobody put in: the first sign of a step that is too long.

#include <mpm/stepping/formulation.hpp>

namespace mpm {

/// Compares the surplus of the energy balance with all energy that passed through the specimen.
///
///   surplus = kinetic + elastic + plastic - external work - what was there at the start
///   turnover = sum of |external work| + kinetic energy at the start + M max(v, c / 10^4)^2 / 2
///
/// Works that cancel count with their sizes, so that what is loaded and released again has its
/// turnover. M is the mass, v the largest speed at which anything starts or is moved from outside,
/// c the speed of the fastest wave: before much work has been done (waves that start from rest) a
/// surplus is small beside the energy of the specimen at that speed, or at a strain of 10^-4. A
/// deficit is dissipation and stops nothing.
template <int Dim>
class EnergyMonitor {
 public:
  /// Of the turnover. docs/theory.md has what sound runs reach.
  static constexpr double bound = 0.1;

  /// kg, and m/s. `largest_speed`: of what is moved from outside.
  EnergyMonitor(double mass, double wave_speed, double largest_speed);

  /// J. Throws NumericalError on every rank if the surplus is beyond its bound, or no number; it
  /// names the particle that has the most energy per mass. Collective.
  void check(const Formulation<Dim>& formulation, double surplus, double turnover);
  /// Surplus over turnover at the last check.
  double gain() const { return gain_; }

 private:
  [[noreturn]] void stop(const Formulation<Dim>& formulation, double surplus) const;

  double floor_;  ///< J
  double gain_ = 0;
};

}  // namespace mpm
