/// What the ranks of a run agree on from time to time, and how it ends when a particle is lost.

#include <mpm/core/error.hpp>
#include <mpm/materials/present_deformation.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpm {

namespace {

/// What a node costs in a step, in particles: it is reset, added to, updated and looked at. Full
/// blocks with 1, 4 and 16 particles per cell (gimp, MUSL): 11 to 14 ns beside 34 ns of a particle.
constexpr double cost_of_node = 0.35;

template <int Dim>
std::string text_of(const Vec<Dim>& v, int digits)
{
  std::string text;
  for (int d = 0; d < Dim; ++d) text += fmt::format("{}{:.{}g}", d ? ", " : "", v[d], digits);
  return text;
}

template <int Dim>
std::string words_for(const typename Exchange<Dim>::Loss& loss, const GridGeometry<Dim>& geometry)
{
  const LostParticle<Dim>& lost = loss.particle;
  const auto tell = [&](const std::string& what, const char* remedy) {
    return fmt::format(
        "particle {} of body '{}' {} at ({}) m in step {}, t = {:.6g} s, with velocity ({}) m/s. "
        "{}",
        lost.id, loss.body, what, text_of<Dim>(lost.position, 6), loss.moment.step,
        loss.moment.time, text_of<Dim>(lost.velocity, 4), remedy);
  };
  if (lost.fault == Fault::inverted && std::isfinite(lost.ratio))
    return tell(fmt::format("was turned inside out, det(I + dt L) = {:.3g},", lost.ratio),
                "Lower numerics.cfl.");
  if (lost.fault == Fault::beyond_bounds && std::isfinite(lost.ratio))
    return tell(fmt::format("has {:.3g} times its first volume, bounds are {} and {},", lost.ratio,
                            least_volume_ratio, largest_volume_ratio),
                "Lower numerics.cfl, or give it a stiffer material.");
  bool outside = false, finite = std::isfinite(lost.ratio);
  for (int d = 0; d < Dim; ++d) {
    finite = finite && std::isfinite(lost.position[d]) && std::isfinite(lost.velocity[d]);
    if (geometry.periodic[d]) continue;
    outside = outside || lost.position[d] < geometry.node_position(d, 1) ||
              lost.position[d] >= geometry.node_position(d, geometry.nodes[d] - 2);
  }
  const char* what = !finite   ? "is no longer a number"
                     : outside ? "left the grid"
                               : "moved by more than a cell in one step";
  const char* remedy = !finite || !outside
                           ? "Lower numerics.cfl."
                           : "Give the grid a wider grid.margin, or lower numerics.cfl.";
  return tell(what, remedy);
}

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
  archive.value("migrated", migrated);
  archive.value("messages", messages);
  archive.value("bytes", bytes);
  archive.value("waiting_seconds", waiting_seconds);
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
  if (largest[4] > never) stop(GlobalIndex(-largest[4]));
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

template <int Dim>
void UpdatedLagrangian<Dim>::stop(GlobalIndex first_loss)
{
  agree(decomposition().comm(), [&] {
    const auto& loss = exchange_->loss();
    if (loss && loss->moment.step == first_loss)
      throw NumericalError(words_for<Dim>(*loss, grid().geometry()), loss->particle.id);
  });
  throw NumericalError("a rank stopped without a reason");  // agree() has thrown before
}

template void UpdatedLagrangian<2>::visit_work(
    const std::function<void(const IndexVec<2>&, double)>&) const;
template void UpdatedLagrangian<3>::visit_work(
    const std::function<void(const IndexVec<3>&, double)>&) const;
template void UpdatedLagrangian<2>::check();
template void UpdatedLagrangian<3>::check();
template void UpdatedLagrangian<2>::stop(GlobalIndex);
template void UpdatedLagrangian<3>::stop(GlobalIndex);

}  // namespace mpm
