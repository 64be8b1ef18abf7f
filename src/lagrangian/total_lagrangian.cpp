#include <mpm/core/error.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/materials/present_deformation.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mpm {

namespace {

/// Way that nodes may have before pairs of cells are looked for again, in locations, at least; and
/// in the way of the fastest node from one check to the next.
constexpr double least_way = 0.25, checks_ahead = 3;

}  // namespace

TotalLagrangian::TotalLagrangian(Decomposition<2> decomposition, Setup setup)
    : decomposition_(std::move(decomposition)), setup_(std::move(setup))
{
  make_mesh();
  add_masses();
  add_loads_on_particles();
  if (setup_.slots.loads.act_on_particles()) halo_->sum(std::array{fields_->load_force_column()});
  if (contact_) {
    contact_->find_pairs(*nodes_, 2 * least_way * setup_.location_size.minCoeff());
    contact_->measure(*nodes_);
  }
}

void TotalLagrangian::step(double dt)
{
  // Velocities stand in the middles of the steps: from one to the next it is half of either. With
  // all of this one, every change of the step would be a kick.
  const double between = steps_ > 0 ? 0.5 * (last_step_ + dt) : dt;
  setup_.slots.loads.apply(*nodes_, runs(), *fields_, time_, between);
  fields_->update_velocity(runs(), between);
  for (const auto& condition : setup_.slots.conditions)
    condition->stop(*nodes_, *fields_, time_, dt);
  setup_.slots.loads.book(*nodes_, runs(), *fields_, between);
  book_friction(between);
  largest_speed_ = std::max(largest_speed_, nodes_->move(*fields_, dt));
  fields_->carry_momentum(runs());
  particles_are_present_ = false;
  time_ += dt;
  ++steps_;
  last_step_ = dt;
  add_forces(dt);
  if (steps_ % steps_between_checks == 0) check();
}

void TotalLagrangian::add_forces(double dt)
{
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    Body<2>& body = setup_.bodies[b];
    const auto inverted =
        cells_[b].update(body, *nodes_, dt, cell_forces_.data() + first_force_[b]);
    if (!inverted || loss_) continue;
    cells_[b].fill_motion(body, *nodes_, *fields_);
    LostParticle<2> lost = lost_particle<2>(body.particles, inverted->cell);
    lost.fault = Fault::inverted;
    lost.ratio = inverted->jacobian;
    loss_ = Loss<2>{lost, body.name, {steps_, time_ - dt}};
  }
  gather_cell_forces();
  if (contact_) {
    contact_->measure(*nodes_);
    contact_->add_forces(*fields_);
    if (setup_.friction > 0) {
      std::fill(friction_.begin(), friction_.end(), 0.0);
      contact_->add_friction(*fields_, setup_.friction, dt, friction_);
    }
  }
  std::vector<NodeColumn> columns{fields_->force_column()};
  if (!friction_.empty()) columns.push_back({friction_.data(), 2, 2});
  if (setup_.slots.loads.act_on_particles()) columns.push_back(fields_->load_force_column());
  add_loads_on_particles();
  halo_->sum(columns);
  for (LocalIndex node = 0; node < LocalIndex(friction_.size() / 2); ++node)
    for (int d = 0; d < 2; ++d)
      fields_->force_of(node)[d] += friction_[std::size_t(node) * 2 + std::size_t(d)];
}

/// What it took from the bodies in the step that ends.
void TotalLagrangian::book_friction(double dt)
{
  for (LocalIndex node = 0; node < LocalIndex(friction_.size() / 2); ++node) {
    if (!nodes_->is_owned(node)) continue;
    const double* u = fields_->updated_of(node);
    for (int d = 0; d < 2; ++d)
      friction_work_ -=
          dt * friction_[std::size_t(node) * 2 + std::size_t(d)] * (u[d] - 0.5 * u[2 + d]);
  }
}

/// f_i of the cells at a node, and no load yet.
void TotalLagrangian::gather_cell_forces()
{
  constexpr int corners = LocationMesh<2>::corners;
  const double* forces = cell_forces_.data();
  const std::int32_t* term = node_terms_.data();
  for (LocalIndex first = 0; first < nodes_->size(); first += lane_count) {
    alignas(lane_alignment) double x[corners * lane_count], y[corners * lane_count];
    for (int k = 0; k < corners * lane_count; ++k) {
      x[k] = forces[term[k]];
      y[k] = forces[term[k] + lane_count];
    }
    term += corners * lane_count;
    Lanes fx = load(x), fy = load(y);
    for (int c = 1; c < corners; ++c) {
      fx += load(x + c * lane_count);
      fy += load(y + c * lane_count);
    }
    const int count = std::min<LocalIndex>(lane_count, nodes_->size() - first);
    for (int lane = 0; lane < count; ++lane) {
      double* f = fields_->force_of(first + lane);
      f[0] = fx[lane];
      f[1] = fy[lane];
    }
  }
}

/// A quarter of each to each corner of its cell, as a partial sum.
void TotalLagrangian::add_loads_on_particles()
{
  const Loads<2>& loads = setup_.slots.loads;
  std::fill(fields_->load_force.begin(), fields_->load_force.end(), 0.0);
  if (!loads.act_on_particles()) return;
  constexpr int corners = LocationMesh<2>::corners;
  const std::vector<Body<2>>& bodies = this->bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (LocalIndex block = 0; block < bodies[b].particles.blocks(); ++block) {
      Lanes force[2] = {0.0, 0.0};
      loads.add_to_particles(bodies[b], block, time_, force);
      const LocalIndex* node = &cells_[b].corner_nodes()[std::size_t(block) * corners * lane_count];
      const int count =
          std::min<LocalIndex>(lane_count, bodies[b].particles.size() - block * lane_count);
      for (int lane = 0; lane < count; ++lane)
        for (int c = 0; c < corners; ++c)
          for (int d = 0; d < 2; ++d)
            fields_->load_force[std::size_t(node[c * lane_count + lane]) * 2 + std::size_t(d)] +=
                force[d][lane] / corners;
    }
}

const std::vector<Body<2>>& TotalLagrangian::bodies() const
{
  if (!particles_are_present_)
    for (std::size_t b = 0; b < cells_.size(); ++b)
      cells_[b].fill_motion(setup_.bodies[b], *nodes_, *fields_);
  particles_are_present_ = true;
  return setup_.bodies;
}

Carried<2> TotalLagrangian::carried() const
{
  Carried<2> carried;
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    if (!nodes_->is_owned(node)) continue;
    const double mass = fields_->mass_of(node);
    const double* u = &fields_->updated[std::size_t(node) * NodeFields<2>::record_width];
    carried.kinetic_energy += 0.5 * mass * (u[0] * u[0] + u[1] * u[1]);
    carried.momentum += mass * Vec<2>(u[0], u[1]);
    carried.added_mass += mass - first_masses_[std::size_t(node)];
  }
  for (std::size_t b = 0; b < cells_.size(); ++b)
    carried.elastic_energy += cells_[b].bending_energy(setup_.bodies[b], *nodes_);
  if (contact_)
    carried.contact = {contact_->energy(), contact_->overlapped_area(), contact_->touching(),
                       friction_work_};
  return carried;
}

void TotalLagrangian::check()
{
  if (checked_ == steps_) return;
  constexpr double never = -std::numeric_limits<double>::infinity();
  double wave_speed = 0;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    Body<2>& body = setup_.bodies[b];
    wave_speed =
        std::max(wave_speed, cells_[b].wave_speed_at_rest(body, *nodes_, setup_.mass_scaling));
    const auto beyond = present_deformation(body).beyond_bounds;
    if (!beyond || loss_) continue;
    cells_[b].fill_motion(body, *nodes_, *fields_);
    LostParticle<2> lost = lost_particle<2>(body.particles, beyond->particle);
    lost.fault = Fault::beyond_bounds;
    lost.ratio = beyond->volume_ratio;
    loss_ = Loss<2>{lost, body.name, {steps_, time_}};
  }
  const double work = particles();
  // The largest of: speeds, work, and minus the step of the first loss; ways of nodes.
  std::array<double, 5> largest{largest_speed_, wave_speed, work,
                                loss_ ? -double(loss_->moment.step) : never,
                                contact_ ? contact_->largest_way(*nodes_) : 0.0};
  const MPI_Comm comm = decomposition_.comm();
  largest_over_ranks(comm, largest);
  if (largest[3] > never)
    stop_at<2>(GlobalIndex(-largest[3]), loss_, comm, decomposition_.geometry());
  double mean = work;
  sum_over_ranks(comm, std::span(&mean, 1));
  mean /= decomposition_.ranks();
  agreed_.largest_speed = largest[0];
  agreed_.wave_speed = largest[1];
  agreed_.busiest_work = largest[2];
  agreed_.mean_work = mean;
  agreed_.most_particles = GlobalIndex(largest[2]);
  agreed_.mean_particles = mean;
  largest_speed_ = 0;
  checked_ = steps_;
  if (contact_) look_for_pairs(largest[4]);
  if (setup_.mass_scaling > 0) scale_masses();
}

/// What they bring and take along is booked as if it came from outside.
void TotalLagrangian::scale_masses()
{
  constexpr int corners = LocationMesh<2>::corners;
  const double bound = setup_.mass_scaling * setup_.mass_scaling;
  const std::vector<double> before(fields_->mass.begin(), fields_->mass.end());
  std::fill(fields_->mass.begin(), fields_->mass.end(), 0.0);
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const ParticleStore& particles = setup_.bodies[b].particles;
    const int mass = particles.motion().find("mass");
    for (LocalIndex block = 0; block < particles.blocks(); ++block) {
      const Lanes least = cells_[b].least_stretch_squared(*nodes_, block);
      if (stdx::none_of(least < bound)) [[likely]]
        continue;
      // A cell at the point of being turned inside out becomes no heavier than this.
      constexpr double least_of_all = 1e-4;
      const Lanes added =
          load(particles.motion().block(block) + mass * lane_count) *
          (stdx::max(bound / stdx::max(least, Lanes(least_of_all)), Lanes(1.0)) - 1.0);
      const LocalIndex* node = &cells_[b].corner_nodes()[std::size_t(block) * corners * lane_count];
      const int count = std::min<LocalIndex>(lane_count, particles.size() - block * lane_count);
      for (int lane = 0; lane < count; ++lane)
        for (int c = 0; c < corners; ++c)
          fields_->mass_of(node[c * lane_count + lane]) += added[lane] / corners;
    }
  }
  halo_->sum(std::array{fields_->mass_column()});
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    double& mass = fields_->mass_of(node);
    mass += first_masses_[std::size_t(node)];
    const double more = mass - before[std::size_t(node)];
    if (more == 0) continue;
    // Mass that comes is at rest, and mass that goes takes its velocity along: neither heats.
    double* u = fields_->updated_of(node);
    const double slower = more > 0 ? before[std::size_t(node)] / mass : 1.0;
    for (int d = 0; d < 2; ++d) {
      const double was = u[d];
      u[d] *= slower;
      fields_->momentum_column()
          .values[std::size_t(node) * NodeFields<2>::record_width + std::size_t(d)] = mass * u[d];
      if (!nodes_->is_owned(node)) continue;
      scaling_.impulse[d] += mass * u[d] - before[std::size_t(node)] * was;
      scaling_.work += 0.5 * (mass * u[d] * u[d] - before[std::size_t(node)] * was * was);
    }
  }
}

/// Pairs stay until a node may have gone half the skin before the next check.
void TotalLagrangian::look_for_pairs(double way)
{
  const double to_next_check = steps_between_checks * last_step_ * agreed_.largest_speed;
  if (way + 1.5 * to_next_check < 0.5 * contact_->skin()) return;
  contact_->find_pairs(*nodes_, 2 * std::max(least_way * setup_.location_size.minCoeff(),
                                             checks_ahead * to_next_check));
  contact_->measure(*nodes_);
}

GlobalIndex TotalLagrangian::repartition(const Ownership<2>&)
{
  throw NumericalError("cells of a total Lagrangian step stay on their rank");
}

void TotalLagrangian::visit_work(const std::function<void(const IndexVec<2>&, double)>& visit) const
{
  const GridGeometry<2>& geometry = decomposition_.geometry();
  for (LocalIndex node = 0; node < nodes_->size(); ++node) {
    Vec<2> rest;
    for (int d = 0; d < 2; ++d) rest[d] = nodes_->rest(node, d);
    visit(geometry.cell_of(rest), 1);
  }
}

Counters TotalLagrangian::counters() const
{
  Counters counters{0, halo_->traffic().messages, halo_->traffic().bytes,
                    halo_->traffic().waiting_seconds};
  if (contact_)
    counters += {0, contact_->messages(), contact_->bytes_sent(), contact_->waiting_seconds()};
  return counters;
}

std::size_t TotalLagrangian::bytes() const
{
  std::size_t bytes =
      nodes_->bytes() + fields_->bytes() + node_terms_.size() * sizeof(int) +
      (cell_forces_.size() + first_masses_.size() + friction_.size()) * sizeof(double);
  for (const LocationCells& cells : cells_) bytes += cells.bytes();
  for (const Body<2>& body : setup_.bodies) bytes += body.particles.bytes();
  return contact_ ? bytes + contact_->bytes() : bytes;
}

void TotalLagrangian::archive(Archive& archive)
{
  archive.value("time", time_);
  archive.value("steps", steps_);
  archive.value("checked", checked_);
  archive.value("last_step", last_step_);
  archive.value("largest_speed", largest_speed_);
  archive.values("friction", friction_);
  archive.value("friction_work", friction_work_);
  {
    const Archive::Section section(archive, "agreed");
    agreed_.archive(archive);
  }
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    const Archive::Section section(archive, "body" + std::to_string(b));
    setup_.bodies[b].particles.archive(archive);
  }
  {
    const Archive::Section section(archive, "scaling");
    scaling_.archive(archive);
  }
  {
    const Archive::Section section(archive, "nodes");
    nodes_->archive(archive);
    fields_->archive(archive);
  }
  setup_.slots.archive(archive);
  if (!archive.is_loading()) return;
  loss_.reset();
  particles_are_present_ = false;
  if (!contact_) return;
  contact_->find_pairs(*nodes_, contact_->skin());
  contact_->measure(*nodes_);
}

void TotalLagrangian::begin_loading(const Ownership<2>&)
{
  loss_.reset();
}

}  // namespace mpm
