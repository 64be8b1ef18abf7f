#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/energy_monitor.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mpm {

namespace {

constexpr double small_strain = 1e-4;

template <int Dim>
struct Hottest {
  double energy_per_mass = -1;  ///< J/kg; infinite where it is no number
  std::string body;
  LostParticle<Dim> particle{};
};

/// Of this rank.
template <int Dim>
Hottest<Dim> hottest_of(const std::vector<Body<Dim>>& bodies)
{
  Hottest<Dim> hottest;
  for (const Body<Dim>& body : bodies) {
    const ParticleStore& particles = body.particles;
    const int mass = particles.motion().find("mass"),
              velocity = particles.motion().find("velocity");
    Lanes elastic = 0;
    for (LocalIndex p = 0; p < particles.size(); ++p) {
      if (p % lane_count == 0)
        elastic = body.law->elastic_energy(particles.state().block(p / lane_count));
      double energy = elastic[std::size_t(p % lane_count)] / particles.motion()(mass, p);
      for (int d = 0; d < Dim; ++d)
        energy += 0.5 * std::pow(particles.motion()(velocity + d, p), 2);
      if (!std::isfinite(energy)) energy = std::numeric_limits<double>::infinity();
      if (energy <= hottest.energy_per_mass) continue;
      hottest = {energy, body.name, lost_particle<Dim>(particles, p)};
    }
  }
  return hottest;
}

template <int Dim>
std::string text_of(const Vec<Dim>& v, const char* format)
{
  return fmt::format(fmt::runtime(format), fmt::join(v.data(), v.data() + Dim, ", "));
}

}  // namespace

template <int Dim>
EnergyMonitor<Dim>::EnergyMonitor(double mass, double wave_speed, double largest_speed)
    : floor_(0.5 * mass * std::pow(std::max(largest_speed, small_strain * wave_speed), 2))
{
}

template <int Dim>
void EnergyMonitor<Dim>::check(const Formulation<Dim>& formulation, double surplus, double turnover)
{
  const double whole = turnover + floor_;
  gain_ = whole > 0 ? surplus / whole : 0;
  if (!(gain_ <= bound)) stop(formulation, surplus);
}

template <int Dim>
void EnergyMonitor<Dim>::stop(const Formulation<Dim>& formulation, double surplus) const
{
  const MPI_Comm comm = formulation.decomposition().comm();
  const Hottest<Dim> hottest = hottest_of(formulation.bodies());
  const double most = largest_over_ranks(comm, hottest.energy_per_mass);
  agree(comm, [&] {
    if (hottest.energy_per_mass < most) return;
    throw NumericalError(
        fmt::format("the energy has grown by {:.4g} J that nobody put in, {:.2g} times the energy "
                    "that passed through (bound {}), by step {}, t = {:.6g} s. Particle {} of body "
                    "'{}' has most of it per mass, at ({}) m, with velocity ({}) m/s. Lower "
                    "numerics.cfl.",
                    surplus, gain_, bound, formulation.steps(), formulation.time(),
                    hottest.particle.id, hottest.body,
                    text_of<Dim>(hottest.particle.position, "{:.6g}"),
                    text_of<Dim>(hottest.particle.velocity, "{:.4g}")),
        hottest.particle.id);
  });
  throw NumericalError("the energy has grown without a particle");  // agree() has thrown before
}

template class EnergyMonitor<2>;
template class EnergyMonitor<3>;

}  // namespace mpm
