#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/history.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

namespace mpm {

namespace {

/// Steps between two readings of the load cell's mean stress.
constexpr GlobalIndex steps_between_readings = 5;
/// And between two looks at the energy balance.
constexpr GlobalIndex steps_between_looks = 200;
/// Of the kinetic energy that the specimen would have at the largest speed: a smaller work is that
/// of a piston which has not met anything yet, and no measure of errors.
constexpr double least_share = 1e-6;

template <int Dim>
double fastest_wave(const Formulation<Dim>& formulation)
{
  double speed = 0;
  for (const Body<Dim>& body : formulation.bodies())
    speed = std::max(speed, body.law->wave_speed());
  return speed;
}

}  // namespace

template <int Dim>
History<Dim>::History(Formulation<Dim>& formulation, std::optional<Apparatus<Dim>> apparatus,
                      double largest_speed)
    : formulation_(formulation),
      apparatus_(std::move(apparatus)),
      start_(sum_over_bodies(formulation_)),
      least_energy_(least_share * 0.5 * start_.mass * largest_speed * largest_speed),
      energy_(start_.mass, fastest_wave(formulation_), largest_speed)
{
}

template <int Dim>
HistoryKind History<Dim>::kind() const
{
  return {apparatus_.has_value(),
          apparatus_ && apparatus_->load_cell_body >= 0,
          start_.contact.has_value(),
          formulation_.has_friction(),
          Dim == 3,
          start_.failed.has_value(),
          start_.added_mass.has_value()};
}

template <int Dim>
void History<Dim>::before_line()
{
  work_ahead_before_ = work_ahead(sum_over_bodies(formulation_));
}

template <int Dim>
void History<Dim>::observe()
{
  if (formulation_.steps() % steps_between_looks == 0) {
    take_reactions();
    energy_.check(formulation_, surplus(sum_over_bodies(formulation_)),
                  work_size_ + start_.kinetic_energy);
  }
  if (kind().load_cell && formulation_.steps() % steps_between_readings == 0) read_load_cell();
}

template <int Dim>
void History<Dim>::read_load_cell()
{
  const AxialStress now = axial_stress(
      formulation_.bodies()[std::size_t(apparatus_->load_cell_body)], apparatus_->axis);
  load_cell_.mass_stress += now.mass_stress;
  load_cell_.mass += now.mass;
}

/// Work and impulse of the step itself, loads, contacts and each condition.
template <int Dim>
void History<Dim>::take_reactions()
{
  std::vector<double> sums;
  const auto append = [&](const Reaction<Dim>& reaction) {
    sums.push_back(reaction.work);
    sums.insert(sums.end(), reaction.impulse.data(), reaction.impulse.data() + Dim);
  };
  Slots<Dim>& slots = formulation_.slots();
  append(formulation_.take_reaction());
  append(slots.loads.take_reaction());
  for (const auto& contact : slots.contacts) append(contact->take_reaction());
  const std::size_t others = 2 + slots.contacts.size();
  for (const auto& condition : slots.conditions) append(condition->take_reaction());
  sum_over_ranks(comm(), sums);
  for (std::size_t k = 0; k < others + slots.conditions.size(); ++k) {
    const double* reaction = &sums[k * (1 + Dim)];
    const Vec<Dim> impulse = Eigen::Map<const Vec<Dim>>(reaction + 1);
    external_work_ += reaction[0];
    work_size_ += std::abs(reaction[0]);
    impulse_ += impulse;
    impulse_size_ += impulse.norm();
    if (!apparatus_ || k < others) continue;
    const auto* condition = slots.conditions[k - others].get();
    if (condition == apparatus_->piston) piston_impulse_ += impulse[apparatus_->axis];
    if (condition == apparatus_->edge) edge_impulse_ += impulse[apparatus_->axis];
  }
}

/// The means since the last line.
template <int Dim>
void History<Dim>::begin_line(HistoryLine& line)
{
  take_reactions();
  line.external_work = external_work_;
  std::array<double, 2> cell{load_cell_.mass_stress, load_cell_.mass};
  load_cell_ = {};
  sum_over_ranks(comm(), cell);
  if (kind().load_cell && !(cell[1] > 0)) {  // the line before was but a few steps ago
    read_load_cell();
    cell = {load_cell_.mass_stress, load_cell_.mass};
    load_cell_ = {};
    sum_over_ranks(comm(), cell);
  }
  if (cell[1] > 0) line.load_cell_stress = -cell[0] / cell[1];
  if (!apparatus_) return;
  // A wall at the upper end pushes towards lower coordinates.
  const double towards = apparatus_->piston->placement().upper ? -1 : 1;
  const double duration = formulation_.kicked_time() - last_kicked_time_;
  const double per_area = duration > 0 ? 1 / (apparatus_->area * duration) : 0;
  // + 0.0: no minus before a zero.
  line.piston_stress = towards * piston_impulse_ * per_area + 0.0;
  line.edge_stress = -towards * edge_impulse_ * per_area + 0.0;
  piston_impulse_ = edge_impulse_ = 0;
}

/// What is too much in the energy balance, J.
template <int Dim>
double History<Dim>::surplus(const Sums<Dim>& sums) const
{
  return sums.kinetic_energy + sums.stress_work() - external_work_ - start_.kinetic_energy -
         start_.stress_work();
}

/// What is stored or dissipated, weighted with how far it is ahead of the velocities, in steps, J.
template <int Dim>
double History<Dim>::work_ahead(const Sums<Dim>& sums) const
{
  constexpr double places = 0.5;
  return formulation_.stress_moment() * (sums.elastic_energy + sums.plastic_work) +
         (sums.contact ? places * sums.contact->energy : 0.0) +
         (sums.failed ? places * sums.failed->energy : 0.0);
}

template <int Dim>
void History<Dim>::balance(HistoryLine& line, const Sums<Dim>& sums)
{
  // Velocities, and with them kinetic energy and external work, stand half a step before the
  // stresses that the step leaves, with USF half a step after them (leap-frog): the work of the
  // stresses is taken there, or the balance would be off by half a step's work. What contact stores
  // goes with the places, half a step after the velocities in every order.
  const double ahead = work_ahead(sums);
  const double last_step = ahead - work_ahead_before_.value_or(ahead);
  work_ahead_before_.reset();
  const double surplus = this->surplus(sums) - last_step;
  const double scale =
      std::max({std::abs(line.external_work), start_.kinetic_energy, least_energy_});
  line.energy_error = scale > 0 ? surplus / scale : 0;
  energy_.check(formulation_, surplus, work_size_ + start_.kinetic_energy);
  const double pushes = impulse_size_ + start_.momentum.norm();
  if (pushes > 0)
    line.momentum_error = (sums.momentum - start_.momentum - impulse_).norm() / pushes;
}

template <int Dim>
const HistoryLine& History<Dim>::record(double dt)
{
  HistoryLine line;
  line.time = formulation_.time();
  line.time_step = dt;
  const Sums<Dim> sums = sum_over_bodies(formulation_);
  line.particles = sums.particles;
  line.kinetic_energy = sums.kinetic_energy;
  line.elastic_energy = sums.elastic_energy;
  line.plastic_work = sums.plastic_work;
  if (sums.contact) {
    line.contact_energy = sums.contact->energy;
    line.overlapped_area = sums.contact->overlapped_area;
    line.deepest_overlap = sums.contact->deepest_overlap;
    line.contact_pairs = sums.contact->pairs;
    line.friction_work = sums.contact->friction_work;
  }
  if (sums.failed) {
    line.failed_cells = sums.failed->cells;
    line.failed_energy = sums.failed->energy;
  }
  line.added_mass = sums.added_mass.value_or(0) / sums.mass;
  begin_line(line);
  if (apparatus_) {
    line.strain = apparatus_->strain(line.time);
    count_outside(line);
  }
  last_kicked_time_ = formulation_.kicked_time();
  check(sums, line);
  balance(line, sums);
  return lines_.emplace_back(line);
}

template <int Dim>
void History<Dim>::check(const Sums<Dim>& sums, const HistoryLine& line) const
{
  // The sums are the same on every rank, so all of them throw or none.
  const FailedCells failed = sums.failed.value_or(FailedCells{});
  if (sums.particles + failed.cells != start_.particles ||
      sums.id_sum + failed.id_sum != start_.id_sum ||
      std::abs(sums.mass + failed.mass - start_.mass) > 1e-9 * start_.mass)
    throw NumericalError(fmt::format(
        "particles were lost or doubled by step {} (t = {:.6g} s): {} of {} particles, sum of ids "
        "{} instead of {}, mass {:.12g} instead of {:.12g} kg. This is a defect of mpm_par: please "
        "report it with the scene and the number of ranks.",
        formulation_.steps(), line.time, sums.particles, start_.particles, sums.id_sum,
        start_.id_sum, sums.mass, start_.mass));
  if (!std::isfinite(sums.kinetic_energy + sums.elastic_energy + line.external_work))
    throw NumericalError(fmt::format(
        "the energy is no longer a number at step {} (t = {:.6g} s). Lower numerics.cfl.",
        formulation_.steps(), line.time));
}

template <int Dim>
void History<Dim>::count_outside(HistoryLine& line)
{
  const Vec<Dim>& spacing = formulation_.decomposition().geometry().spacing;
  const std::array<const RigidWall<Dim>*, 1> moving{apparatus_->piston};
  const Penetration piston =
      find_behind<Dim>(comm(), formulation_.bodies(), moving, line.time, spacing);
  const Penetration outside =
      find_behind<Dim>(comm(), formulation_.bodies(), apparatus_->at_rest, line.time, spacing);
  line.behind_piston = piston.particles;
  line.outside_walls = outside.particles;
  deepest_behind_piston_ = std::max(deepest_behind_piston_, piston.deepest);
  warn_of(piston, "the piston's face");
  warn_of(outside, "a wall");
}

template <int Dim>
void History<Dim>::warn_of(const Penetration& found, const char* what) const
{
  if (found.ids.empty()) return;
  spdlog::warn("step {}: particles more than one cell behind {}: ids {}", formulation_.steps(),
               what, fmt::join(found.ids, ", "));
}

template <int Dim>
void History<Dim>::archive(Archive& archive)
{
  archive.value("external_work", external_work_);
  archive.values("impulse", {impulse_.data(), std::size_t(Dim)});
  archive.value("impulse_size", impulse_size_);
  archive.value("work_size", work_size_);
  archive.value("piston_impulse", piston_impulse_);
  archive.value("edge_impulse", edge_impulse_);
  archive.value("last_kicked_time", last_kicked_time_);
  archive.value("load_cell_mass_stress", load_cell_.mass_stress, Over::sum);
  archive.value("load_cell_mass", load_cell_.mass, Over::sum);
  archive.value("deepest_behind_piston", deepest_behind_piston_);
  int line_is_due = work_ahead_before_.has_value();
  archive.value("line_is_due", line_is_due);
  double ahead = work_ahead_before_.value_or(0);
  archive.value("work_ahead_before", ahead);
  work_ahead_before_.reset();
  if (line_is_due != 0) work_ahead_before_ = ahead;
  archive_lines(archive, lines_);
  const Archive::Section section(archive, "start");
  archive.value("particles", start_.particles);
  archive.value("id_sum", start_.id_sum);
  archive.value("mass", start_.mass);
  archive.value("kinetic_energy", start_.kinetic_energy);
  archive.value("elastic_energy", start_.elastic_energy);
  archive.value("plastic_work", start_.plastic_work);
  archive.values("momentum", {start_.momentum.data(), std::size_t(Dim)});
}

template class History<2>;
template class History<3>;

}  // namespace mpm
