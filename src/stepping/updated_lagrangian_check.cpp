/// What the ranks of a run agree on from time to time.

#include <mpm/materials/present_deformation.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace mpm {

namespace {

/// What a node costs in a step, in particles: it is reset, added to, updated and looked at. Full
/// blocks with 1, 4 and 16 particles per cell (gimp, MUSL): 11 to 14 ns beside 34 ns of a particle.
constexpr double cost_of_node = 0.35;

}  // namespace

void Agreed::archive(Archive& archive)
{
  archive.value("largest_speed", largest_speed);
  archive.value("wave_speed", wave_speed);
  archive.value("busiest_work", busiest_work);
  archive.value("mean_work", mean_work);
  archive.value("most_particles", most_particles);
  archive.value("mean_particles", mean_particles);
}

Counters& Counters::operator+=(const Counters& other)
{
  migrated += other.migrated;
  messages += other.messages;
  bytes += other.bytes;
  waiting_seconds += other.waiting_seconds;
  return *this;
}

Counters& Counters::operator-=(const Counters& other)
{
  migrated -= other.migrated;
  messages -= other.messages;
  bytes -= other.bytes;
  waiting_seconds -= other.waiting_seconds;
  return *this;
}

void Counters::archive(Archive& archive)
{
  archive.value("migrated", migrated, Over::sum);
  archive.value("messages", messages, Over::largest);
  archive.value("bytes", bytes, Over::largest);
  archive.value("waiting_seconds", waiting_seconds, Over::largest);
}

template <int Dim>
void UpdatedLagrangian<Dim>::visit_work(
    const std::function<void(const IndexVec<Dim>&, double)>& visit) const
{
  const GridGeometry<Dim>& geometry = decomposition().geometry();
  for (const Body<Dim>& body : bodies())
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      Vec<Dim> position;
      for (int d = 0; d < Dim; ++d) position[d] = body.particles.motion()(d, p);
      visit(geometry.cell_of(position), 1);
    }
  for (const NodeRun<Dim>& run : grid().runs())
    for (LocalIndex node = run.first; node < run.first + run.length; ++node)
      if (grid().is_owned(node)) visit(grid().index(node), cost_of_node);
}

template <int Dim>
void UpdatedLagrangian<Dim>::check()
{
  if (checked_ == steps_) return;
  constexpr double never = -std::numeric_limits<double>::infinity();
  double wave_speed = 0;
  for (const Body<Dim>& body : bodies()) {
    const PresentDeformation present = present_deformation(body);
    wave_speed = std::max(wave_speed, present.wave_speed);
    if (const auto& beyond = present.beyond_bounds) {
      LostParticle<Dim> lost = lost_particle<Dim>(body.particles, beyond->particle);
      lost.fault = Fault::beyond_bounds;
      lost.ratio = beyond->volume_ratio;
      exchange_->note_loss(body, lost, {steps_, time_});
    }
  }
  const auto& loss = exchange_->loss();
  const double particles = this->particles();
  const double work = particles + cost_of_node * grid().active_nodes();
  // The largest of: speeds, work, particles, and minus the step of the first loss.
  std::array<double, 5> largest{exchange_->largest_speed(), wave_speed, work, particles,
                                loss ? -double(loss->moment.step) : never};
  const MPI_Comm comm = decomposition().comm();
  largest_over_ranks(comm, largest);
  if (largest[4] > never)
    stop_at<Dim>(GlobalIndex(-largest[4]), loss, comm, decomposition().geometry());
  std::array<double, 2> mean{work, particles};
  sum_over_ranks(comm, mean);
  for (double& value : mean) value /= decomposition().ranks();
  agreed_.largest_speed = largest[0];
  agreed_.wave_speed = largest[1];
  agreed_.busiest_work = largest[2];
  agreed_.mean_work = mean[0];
  agreed_.most_particles = GlobalIndex(largest[3]);
  agreed_.mean_particles = mean[1];
  checked_ = steps_;
}

template void UpdatedLagrangian<2>::visit_work(
    const std::function<void(const IndexVec<2>&, double)>&) const;
template void UpdatedLagrangian<3>::visit_work(
    const std::function<void(const IndexVec<3>&, double)>&) const;
template void UpdatedLagrangian<2>::check();
template void UpdatedLagrangian<3>::check();

}  // namespace mpm
