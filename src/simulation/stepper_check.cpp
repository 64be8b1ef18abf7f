/// What the ranks of a run agree on from time to time, and how it ends when a particle is lost.

#include <mpm/core/error.hpp>
#include <mpm/materials/present_wave_speed.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/stepper.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpm {

namespace {

template <int Dim>
std::string text_of(const Vec<Dim>& v, int digits)
{
  std::string text;
  for (int d = 0; d < Dim; ++d) text += fmt::format("{}{:.{}g}", d ? ", " : "", v[d], digits);
  return text;
}

template <int Dim>
std::string words_for(const LostParticle<Dim>& lost, const GridGeometry<Dim>& geometry,
                      const std::string& body, GlobalIndex step, double time)
{
  bool outside = false, finite = true;
  for (int d = 0; d < Dim; ++d) {
    finite = finite && std::isfinite(lost.position[d]) && std::isfinite(lost.velocity[d]);
    outside = outside || lost.position[d] < geometry.node_position(d, 1) ||
              lost.position[d] >= geometry.node_position(d, geometry.nodes[d] - 2);
  }
  const char* what = !finite   ? "is no longer a number"
                     : outside ? "left the grid"
                               : "moved by more than a cell in one step";
  const char* remedy = !finite || !outside
                           ? "Lower numerics.cfl, or look at the last snapshots."
                           : "Give the grid a wider grid.margin, or lower numerics.cfl.";
  return fmt::format(
      "particle {} of body '{}' {} at ({}) m in step {}, t = {:.6g} s, with velocity ({}) m/s. {}",
      lost.id, body, what, text_of<Dim>(lost.position, 6), step, time,
      text_of<Dim>(lost.velocity, 4), remedy);
}

}  // namespace

template <int Dim>
void Stepper<Dim>::check()
{
  if (checked_ == steps_) return;
  constexpr double never = -std::numeric_limits<double>::infinity();
  double wave_speed = 0;
  for (const Body<Dim>& body : bodies_) wave_speed = std::max(wave_speed, present_wave_speed(body));
  // A few steps between two lines of the history say little.
  if (const GlobalIndex steps = steps_ - measured_from_; steps >= steps_between_checks / 2) {
    if (particles() > 0) particle_seconds_.add(busy_.seconds() / double(steps) / particles());
    measure_anew();
  }
  const double work = particle_seconds_.value() * particles();
  // The largest of: speeds, time of work, particles, and minus the step of the first loss.
  std::array<double, 5> largest{largest_speed_, wave_speed, work, double(particles()),
                                loss_ ? -double(loss_->step) : never};
  const MPI_Comm comm = decomposition_.comm();
  largest_over_ranks(comm, largest);
  if (largest[4] > never) stop(GlobalIndex(-largest[4]));
  std::array<double, 2> mean{work, double(particles())};
  sum_over_ranks(comm, mean);
  for (double& value : mean) value /= decomposition_.ranks();
  agreed_.largest_speed = largest[0];
  agreed_.wave_speed = largest[1];
  agreed_.busiest_seconds = largest[2];
  agreed_.mean_seconds = mean[0];
  agreed_.own_seconds = work;
  agreed_.most_particles = GlobalIndex(largest[3]);
  agreed_.mean_particles = mean[1];
  checked_ = steps_;
}

template <int Dim>
void Stepper<Dim>::note_loss(std::size_t body, const LostParticle<Dim>& lost)
{
  if (!loss_) loss_ = Loss{lost, bodies_[body].name, steps_ + 1, time_};
}

template <int Dim>
LostParticle<Dim> Stepper<Dim>::strayed(std::size_t body, LocalIndex particle) const
{
  const ParticleStore& particles = bodies_[body].particles;
  const int velocity = particles.motion().find("velocity");
  LostParticle<Dim> lost{particles.ids()[particle]};
  for (int d = 0; d < Dim; ++d) {
    lost.position[d] = particles.motion()(d, particle);
    lost.velocity[d] = particles.motion()(velocity + d, particle);
  }
  return lost;
}

template <int Dim>
void Stepper<Dim>::stop(GlobalIndex first_loss)
{
  agree(decomposition_.comm(), [&] {
    if (loss_ && loss_->step == first_loss)
      throw NumericalError(
          words_for(loss_->particle, grid_.geometry(), loss_->body, loss_->step, loss_->time));
  });
  throw NumericalError("a rank stopped without a reason");  // agree() has thrown before
}

template void Stepper<2>::check();
template void Stepper<3>::check();
template void Stepper<2>::note_loss(std::size_t, const LostParticle<2>&);
template void Stepper<3>::note_loss(std::size_t, const LostParticle<3>&);
template LostParticle<2> Stepper<2>::strayed(std::size_t, LocalIndex) const;
template LostParticle<3> Stepper<3>::strayed(std::size_t, LocalIndex) const;
template void Stepper<2>::stop(GlobalIndex);
template void Stepper<3>::stop(GlobalIndex);

}  // namespace mpm
