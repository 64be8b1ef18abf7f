#include <mpm/core/error.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/materials/present_deformation.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace mpm {

namespace {

/// Way that nodes may have before pairs of cells are looked for again: in locations, at least; and
/// from one check to the next, in their own way and in that of the fastest node, which may hit any.
constexpr double least_way = 0.25, checks_ahead = 2;

}  // namespace

template <int Dim>
TotalLagrangian<Dim>::TotalLagrangian(Decomposition<Dim> decomposition, Setup setup)
    : decomposition_(std::move(decomposition)),
      setup_(std::move(setup)),
      fitted_(largest_over_ranks(decomposition_.comm(), !setup_.offsets.empty()) > 0)
{
  for ([[maybe_unused]] const Body<Dim>& body : setup_.bodies)
    MPM_ASSERT(std::ranges::is_sorted(body.particles.ids()));
  make_mesh();
  add_masses();
  add_loads_on_particles();
  if (setup_.slots.loads.act_on_particles()) halo_->sum(std::array{fields_->load_force_column()});
  for (LocalIndex node = 0; node < nodes_->size(); ++node)
    largest_speed_ =
        std::max(largest_speed_, Eigen::Map<const Vec<Dim>>(fields_->updated_of(node)).norm());
  fastest_ = largest_over_ranks(decomposition_.comm(), largest_speed_);
  if (contact_) {
    find_pairs();
    contact_->measure(*nodes_);
  }
  checked_ = -1;  // what touches at rest, or will soon, sets the first step
  check();
  given_.take();              // masses of the start are what the run begins with
  agreed_.largest_speed = 0;  // who chooses the first step knows that of the start
}

template <int Dim>
void TotalLagrangian<Dim>::step(double dt)
{
  // Velocities stand in the middles of the steps: from one to the next it is half of either. With
  // all of this one, every change of the step would be a kick.
  const double between = steps_ > 0 ? 0.5 * (last_step_ + dt) : dt;
  setup_.slots.loads.apply(*nodes_, runs(), *fields_, time_, between);
  fields_->update_velocity(runs(), between);
  for (const auto& condition : setup_.slots.conditions)
    condition->stop(*nodes_, *fields_, time_, dt);
  lead_rigid_bodies(dt);
  setup_.slots.loads.book(*nodes_, runs(), *fields_, between);
  book_friction(between);
  largest_speed_ = std::max(largest_speed_, nodes_->move(*fields_, dt));
  particles_are_present_ = false;
  time_ += dt;
  kicked_time_ += between;
  ++steps_;
  last_step_ = dt;
  add_forces(dt);
  // How fast bodies come is known from the first step on: their pairs are found before they meet.
  if (steps_ == 1 || steps_ % steps_between_checks == 0) check();
}

template <int Dim>
const std::vector<Body<Dim>>& TotalLagrangian<Dim>::bodies() const
{
  if (!particles_are_present_)
    for (std::size_t b = 0; b < cells_.size(); ++b)
      cells_[b].fill_motion(setup_.bodies[b], *nodes_, *fields_);
  particles_are_present_ = true;
  return setup_.bodies;
}

template <int Dim>
Carried<Dim> TotalLagrangian<Dim>::carried() const
{
  Carried<Dim> carried;
  double added_mass = 0;
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    if (!nodes_->is_owned(node) || is_rigid(node)) continue;
    const double mass = fields_->mass_of(node);
    const double* u = &fields_->updated[std::size_t(node) * NodeFields<Dim>::record_width];
    const Eigen::Map<const Vec<Dim>> velocity(u);
    carried.kinetic_energy += 0.5 * mass * velocity.squaredNorm();
    carried.momentum += mass * velocity;
    added_mass += mass - first_masses_[std::size_t(node)];
  }
  if (setup_.mass_scaling > 0) carried.added_mass = added_mass;
  for (std::size_t b = 0; b < cells_.size(); ++b)
    carried.elastic_energy += cells_[b].bending_energy(setup_.bodies[b], *nodes_);
  if (contact_)
    carried.contact = {contact_->energy(), contact_->overlapped_area(), contact_->deepest_overlap(),
                       contact_->touching(), friction_work_};
  for (const auto& condition : setup_.slots.conditions) {
    if (!condition->rubs()) continue;
    if (!carried.contact) carried.contact.emplace();
    carried.contact->friction_work += condition->friction_work();
  }
  if (cells_may_fail()) carried.failed = failed_;
  return carried;
}

template <int Dim>
bool TotalLagrangian<Dim>::has_friction()
{
  return setup_.pairs.any() ||
         std::ranges::any_of(setup_.slots.conditions,
                             [](const auto& condition) { return condition->rubs(); });
}

template <int Dim>
void TotalLagrangian<Dim>::check()
{
  if (checked_ == steps_) return;
  constexpr double never = -std::numeric_limits<double>::infinity();
  double wave_speed = 0;
  for (std::size_t b = 0; b < cells_.size(); ++b)
    cells_[b].find_least_stretches(*nodes_, least_stretches_[b]);
  if (contact_) {
    // Both sides may come as fast as the fastest node of the last check, which all ranks know.
    contact_->count_stiffness(least_stretches_, 2 * way_to_next_check());
  }
  const std::vector<double> failed = remove_failed();
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    Body<Dim>& body = setup_.bodies[b];
    wave_speed = std::max(
        wave_speed, cells_[b].wave_speed_at_rest(body, least_stretches_[b], setup_.mass_scaling));
    const auto beyond = present_deformation(body).beyond_bounds;
    if (!beyond || loss_) continue;
    cells_[b].fill_motion(body, *nodes_, *fields_);
    LostParticle<Dim> lost = lost_particle<Dim>(body.particles, beyond->particle);
    lost.fault = Fault::beyond_bounds;
    lost.ratio = beyond->volume_ratio;
    loss_ = Loss<Dim>{lost, body.name, {steps_, time_}};
  }
  const double particles = this->particles();
  double work = particles;  // as visit_work has it, without asking where
  if (contact_) contact_->visit_work([&](const IndexVec<Dim>&, double more) { work += more; });
  // The largest of: speeds, work, and minus the step of the first loss; what nodes lack of room;
  // what failed; particles.
  std::array<double, 7> largest{
      largest_speed_,
      wave_speed,
      work,
      loss_ ? -double(loss_->moment.step) : never,
      contact_ ? contact_->beyond_rooms(*nodes_, ways_to_next_check()) : never,
      double(failed.size()),
      particles};
  const MPI_Comm comm = decomposition_.comm();
  largest_over_ranks(comm, largest);
  if (largest[3] > never)
    stop_at<Dim>(GlobalIndex(-largest[3]), loss_, comm, decomposition_.geometry());
  std::array<double, 2> mean{work, particles};
  sum_over_ranks(comm, mean);
  for (double& value : mean) value /= decomposition_.ranks();
  agreed_.largest_speed = fastest_ = largest[0];
  agreed_.wave_speed = largest[1];
  agreed_.busiest_work = largest[2];
  agreed_.mean_work = mean[0];
  agreed_.most_particles = GlobalIndex(largest[6]);
  agreed_.mean_particles = mean[1];
  largest_speed_ = 0;
  checked_ = steps_;
  if (largest[5] > 0) {
    part(failed);
    largest[4] = never;
  }
  // Until the next check nodes go on, and that one looks as far ahead as the fastest goes until the
  // one after it: all that may meet by then has to be listed.
  if (contact_ && largest[4] + contact_->reach() * way_to_next_check() > 0) renew_pairs();
  if (setup_.mass_scaling > 0) scale_masses();
}

/// What they bring and take along is booked as if it came from outside.
template <int Dim>
void TotalLagrangian<Dim>::scale_masses()
{
  constexpr int corners = LocationMesh<Dim>::corners;
  const double bound = setup_.mass_scaling * setup_.mass_scaling;
  std::vector<double> before(std::size_t(nodes_->size()));
  const auto momentum_of = [&](LocalIndex node) {
    return &fields_->momentum_column().values[std::size_t(node) * NodeFields<Dim>::record_width];
  };
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    before[std::size_t(node)] = std::exchange(fields_->mass_of(node), 0.0);
    std::fill_n(momentum_of(node), Dim, 0.0);
  }
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const ParticleStore& particles = setup_.bodies[b].particles;
    const int mass = particles.motion().find("mass");
    for (LocalIndex block = 0; block < particles.blocks(); ++block) {
      const Lanes least = column(least_stretches_[b].data(), block);
      if (stdx::none_of(least < bound)) [[likely]]
        continue;
      constexpr double least_of_all = LocationCells<Dim>::least_of_all;
      const Lanes added =
          load(particles.motion().block(block) + mass * lane_count) *
          (stdx::max(bound / stdx::max(least, Lanes(least_of_all)), Lanes(1.0)) - 1.0);
      const LocalIndex* node = &cells_[b].corner_nodes()[std::size_t(block) * corners * lane_count];
      const int count = std::min<LocalIndex>(lane_count, particles.size() - block * lane_count);
      for (int lane = 0; lane < count; ++lane) {
        if (!(added[lane] > 0)) continue;
        Vec<Dim> velocity = Vec<Dim>::Zero();
        for (int c = 0; c < corners; ++c)
          velocity += Eigen::Map<const Vec<Dim>>(fields_->updated_of(node[c * lane_count + lane]));
        velocity /= corners;
        for (int c = 0; c < corners; ++c) {
          const LocalIndex corner = node[c * lane_count + lane];
          const double share = added[lane] / corners;
          fields_->mass_of(corner) += share;
          for (int d = 0; d < Dim; ++d) momentum_of(corner)[d] += share * velocity[d];
        }
      }
    }
  }
  halo_->sum(std::array{fields_->mass_column(), fields_->momentum_column()});
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    double& mass = fields_->mass_of(node);
    const double added = mass;
    mass += is_rigid(node) ? rigid_mass_ : first_masses_[std::size_t(node)];
    const double more = mass - before[std::size_t(node)];
    // Mass that comes moves as its cells do, and mass that goes takes its velocity along: neither
    // heats, and neither slows what moves as a whole.
    // Where none was added there is none that comes, whatever rounding says of a mass that was
    // saved.
    const double share = added > 0 && more > 0 ? more / mass : 0.0;
    double* u = fields_->updated_of(node);
    for (int d = 0; d < Dim; ++d) {
      const double was = u[d];
      if (share > 0) u[d] += share * (momentum_of(node)[d] / added - was);
      momentum_of(node)[d] = mass * u[d];
      if (!nodes_->is_owned(node)) continue;
      given_.impulse[d] += mass * u[d] - before[std::size_t(node)] * was;
      given_.work += 0.5 * (mass * u[d] * u[d] - before[std::size_t(node)] * was * was);
    }
  }
}

/// In the longest steps: the next ones may be that long however short the last one was.
template <int Dim>
double TotalLagrangian<Dim>::time_to_next_check() const
{
  return steps_between_checks * std::max(setup_.longest_step, last_step_);
}

/// Of the fastest node of the last check.
template <int Dim>
double TotalLagrangian<Dim>::way_to_next_check() const
{
  return time_to_next_check() * fastest_;
}

/// Of every node, at its present speed.
template <int Dim>
std::vector<double> TotalLagrangian<Dim>::ways_to_next_check() const
{
  const double time = time_to_next_check();
  std::vector<double> ways;
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    const double* u = &fields_->updated[std::size_t(node) * NodeFields<Dim>::record_width];
    ways.push_back(time * Eigen::Map<const Vec<Dim>>(u).norm());
  }
  return ways;
}

/// Slow nodes get less room than fast ones, so that few pairs are listed for each.
template <int Dim>
void TotalLagrangian<Dim>::find_pairs()
{
  const double least = least_way * setup_.location_size.minCoeff(),
               ahead = checks_ahead * contact_->reach(), of_fastest = ahead * way_to_next_check();
  std::vector<double> rooms = ways_to_next_check();
  for (double& room : rooms) room = std::max(least, ahead * room) + of_fastest;
  contact_->find_pairs(*nodes_, std::move(rooms));
}

/// In the middle of a run: what touches has been counted.
template <int Dim>
void TotalLagrangian<Dim>::renew_pairs()
{
  find_pairs();
  contact_->measure(*nodes_);
  contact_->forget_stiffness();
}

template <int Dim>
Counters TotalLagrangian<Dim>::counters() const
{
  Counters counters = earlier_;
  counters +=
      {0, halo_->traffic().messages, halo_->traffic().bytes, halo_->traffic().waiting_seconds};
  if (contact_)
    counters += {0, contact_->messages(), contact_->bytes_sent(), contact_->waiting_seconds()};
  return counters;
}

template <int Dim>
std::size_t TotalLagrangian<Dim>::bytes() const
{
  std::size_t bytes =
      nodes_->bytes() + fields_->bytes() + node_terms_.size() * sizeof(int) +
      (cell_forces_.size() + first_masses_.size() + friction_.size()) * sizeof(double);
  for (const LocationCells<Dim>& cells : cells_) bytes += cells.bytes();
  for (const auto& stretches : least_stretches_) bytes += stretches.size() * sizeof(double);
  for (const Body<Dim>& body : setup_.bodies) bytes += body.particles.bytes();
  bytes += setup_.offsets.bytes() + removed_.capacity() * sizeof(RestCell<Dim>);
  return contact_ ? bytes + contact_->bytes() : bytes;
}

template class TotalLagrangian<2>;
template class TotalLagrangian<3>;

}  // namespace mpm
