#pragma once
/// How long a step may be.

#include <mpm/stepping/formulation.hpp>

#include <algorithm>

namespace mpm {

/// dt = CFL h / (c + |v|) with the fastest wave c and the largest speed |v| of all particles as
/// they are, at least those of the start; in which no particle crosses more than half a cell; and
/// no longer than loads, contact and transport bear. Plan, run and history ask the same object.
class TimeStep {
 public:
  /// `spacing`: the smallest, m; `wave_speed` of the stiffest body and `speed` at the start, m/s.
  TimeStep(double cfl, double spacing, double wave_speed, double speed)
      : cfl_(cfl), spacing_(spacing), wave_speed_(wave_speed), speed_(speed)
  {
  }

  double first() const { return step(wave_speed_, speed_); }  ///< s
  /// By what the ranks agreed on last, s.
  template <int Dim>
  double next(const Formulation<Dim>& formulation) const
  {
    const Agreed& agreed = formulation.agreed();
    const double wave = std::max(wave_speed_, agreed.wave_speed);
    const double speed = std::max(speed_, agreed.largest_speed);
    return std::min(step(wave, speed), formulation.largest_step());
  }

 private:
  double step(double wave, double speed) const
  {
    constexpr double most_cells = 0.5;
    const double by_waves = cfl_ * spacing_ / (wave + speed);
    return by_waves * speed > most_cells * spacing_ ? most_cells * spacing_ / speed : by_waves;
  }

  double cfl_, spacing_, wave_speed_, speed_;
};

}  // namespace mpm
