#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/recorder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

namespace mpm {

namespace {

/// Steps between two readings of the load cell's mean stress.
constexpr GlobalIndex steps_between_readings = 5;

std::vector<output::HistoryColumn> columns(const std::optional<Apparatus>& apparatus)
{
  std::vector<output::HistoryColumn> list{{"time", "s"}};
  if (apparatus) {
    list.push_back({"strain", "1"});
    list.push_back({"stress", "Pa"});
    list.push_back({"stress_piston", "Pa"});
    list.push_back({"stress_edge", "Pa"});
    if (apparatus->load_cell_body >= 0) list.push_back({"stress_load_cell", "Pa"});
  }
  for (const char* energy : {"kinetic_energy", "elastic_energy", "plastic_work", "external_work"})
    list.push_back({energy, "J"});
  list.push_back({"energy_error", "1"});
  list.push_back({"momentum_error", "1"});
  list.push_back({"particles", "1"});
  list.push_back({"time_step", "s"});
  if (apparatus) {
    list.push_back({"behind_piston", "1"});
    list.push_back({"outside_walls", "1"});
  }
  return list;
}

std::vector<double> row(const HistoryLine& line, const std::optional<Apparatus>& apparatus)
{
  std::vector<double> values{line.time};
  if (apparatus) {
    values.insert(values.end(), {line.strain, line.stress(), line.piston_stress, line.edge_stress});
    if (apparatus->load_cell_body >= 0) values.push_back(line.load_cell_stress);
  }
  values.insert(values.end(), {line.sums.kinetic_energy, line.sums.elastic_energy,
                               line.sums.plastic_work, line.external_work, line.energy_error,
                               line.momentum_error, double(line.sums.particles), line.time_step});
  if (apparatus)
    values.insert(values.end(), {double(line.behind_piston), double(line.outside_walls)});
  return values;
}

}  // namespace

History::History(const std::filesystem::path& folder, const Formulation<2>& formulation,
                 std::vector<BoundaryCondition<2>*> conditions, std::optional<Apparatus> apparatus)
    : comm_(formulation.decomposition().comm()),
      conditions_(std::move(conditions)),
      apparatus_(std::move(apparatus))
{
  agree(comm_, [&] {
    if (rank_of(comm_) == 0)
      file_ = std::make_unique<output::HistoryFile>(folder / "history.csv", columns(apparatus_));
  });
  start_ = sum_particles(comm_, formulation.bodies());
}

void History::before_line(const Formulation<2>& formulation)
{
  stress_work_before_ = sum_particles(comm_, formulation.bodies()).stress_work();
}

void History::observe(const Formulation<2>& formulation)
{
  if (!apparatus_ || apparatus_->load_cell_body < 0) return;
  if (formulation.steps() % steps_between_readings != 0) return;
  const AxialStress now =
      axial_stress(formulation.bodies()[apparatus_->load_cell_body], apparatus_->axis);
  load_cell_.mass_stress += now.mass_stress;
  load_cell_.mass += now.mass;
}

const HistoryLine& History::record(const Formulation<2>& formulation, double dt)
{
  HistoryLine line;
  line.time = formulation.time();
  line.time_step = dt;
  line.sums = sum_particles(comm_, formulation.bodies());

  // Load cell, then work and impulse of each condition.
  std::vector<double> sums{load_cell_.mass_stress, load_cell_.mass};
  for (BoundaryCondition<2>* condition : conditions_) {
    const Reaction<2> reaction = condition->take_reaction();
    sums.insert(sums.end(), {reaction.work, reaction.impulse[0], reaction.impulse[1]});
  }
  load_cell_ = {};
  sum_over_ranks(comm_, sums);
  if (sums[1] > 0) line.load_cell_stress = -sums[0] / sums[1];
  double piston_impulse = 0, edge_impulse = 0;  // along the axis
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    const Vec<2> impulse(sums[3 * k + 3], sums[3 * k + 4]);
    external_work_ += sums[3 * k + 2];
    impulse_ += impulse;
    impulse_size_ += impulse.norm();
    if (!apparatus_) continue;
    if (conditions_[k] == apparatus_->piston) piston_impulse = impulse[apparatus_->axis];
    if (conditions_[k] == apparatus_->edge) edge_impulse = impulse[apparatus_->axis];
  }
  line.external_work = external_work_;
  if (apparatus_) {
    line.strain =
        std::abs(apparatus_->piston->motion().displacement(line.time)) / apparatus_->length;
    // A wall at the upper end pushes towards lower coordinates.
    const double towards = apparatus_->piston->placement().upper ? -1 : 1;
    const double per_area = 1 / (apparatus_->area * std::max(line.time - last_time_, 1e-300));
    // + 0.0: no minus before a zero.
    line.piston_stress = towards * piston_impulse * per_area + 0.0;
    line.edge_stress = -towards * edge_impulse * per_area + 0.0;
    count_outside(formulation, line);
  }
  last_time_ = line.time;
  // Velocities, and with them kinetic energy and external work, stand half a step before the
  // stresses that the step leaves, with USF half a step after them (leap-frog): the work of the
  // stresses is taken there, or the balance would be off by half a step's work.
  const double stress_work = line.sums.stress_work();
  const double last_step = stress_work - stress_work_before_.value_or(stress_work);
  stress_work_before_.reset();
  const double surplus = line.sums.kinetic_energy + stress_work +
                         formulation.stress_moment() * -last_step -
                         line.external_work - start_.kinetic_energy - start_.stress_work();
  const double scale = std::max(std::abs(line.external_work), start_.kinetic_energy);
  line.energy_error = scale > 0 ? surplus / scale : 0;
  const double pushes = impulse_size_ + start_.momentum.norm();
  if (pushes > 0)
    line.momentum_error = (line.sums.momentum - start_.momentum - impulse_).norm() / pushes;
  check(formulation, line);
  agree(comm_, [&] {
    if (file_) file_->append(row(line, apparatus_));
  });
  return lines_.emplace_back(line);
}

void History::check(const Formulation<2>& formulation, const HistoryLine& line) const
{
  // The sums are the same on every rank, so all of them throw or none.
  if (line.sums.particles != start_.particles || line.sums.id_sum != start_.id_sum ||
      std::abs(line.sums.mass - start_.mass) > 1e-9 * start_.mass)
    throw NumericalError(fmt::format(
        "particles were lost or doubled by step {} (t = {:.6g} s): {} of {} particles, sum of ids "
        "{} instead of {}, mass {:.12g} instead of {:.12g} kg. This is a defect of mpm_par: please "
        "report it with the scene and the number of ranks.",
        formulation.steps(), line.time, line.sums.particles, start_.particles, line.sums.id_sum,
        start_.id_sum, line.sums.mass, start_.mass));
  if (!std::isfinite(line.sums.kinetic_energy + line.sums.elastic_energy + line.external_work))
    throw NumericalError(fmt::format(
        "the energy is no longer a number at step {} (t = {:.6g} s). Lower numerics.cfl.",
        formulation.steps(), line.time));
}

void History::count_outside(const Formulation<2>& formulation, HistoryLine& line)
{
  const Vec<2>& spacing = formulation.decomposition().geometry().spacing;
  const Penetration piston =
      find_behind(comm_, formulation.bodies(), {apparatus_->piston}, line.time, spacing);
  std::vector<const RigidWall<2>*> walls{apparatus_->edge};
  for (const RigidWall<2>* lateral : apparatus_->lateral)
    if (lateral) walls.push_back(lateral);
  const Penetration outside = find_behind(comm_, formulation.bodies(), walls, line.time, spacing);
  line.behind_piston = piston.particles;
  line.outside_walls = outside.particles;
  deepest_behind_piston_ = std::max(deepest_behind_piston_, piston.deepest);
  warn_of(formulation, piston, "the piston's face");
  warn_of(formulation, outside, "a wall");
}

void History::warn_of(const Formulation<2>& formulation, const Penetration& found, const char* what) const
{
  if (found.ids.empty()) return;
  spdlog::warn("step {}: particles more than one cell behind {}: ids {}", formulation.steps(), what,
               fmt::join(found.ids, ", "));
}

namespace {

using output::ParticleField;
using scene::Field;

std::size_t count(const std::vector<Body<2>>& bodies)
{
  std::size_t particles = 0;
  for (const Body<2>& body : bodies) particles += std::size_t(body.particles.size());
  return particles;
}

/// Column of a state field; zeros for bodies that do not have it.
std::vector<double> state_column(const std::vector<Body<2>>& bodies, const std::string& name)
{
  std::vector<double> values;
  values.reserve(count(bodies));
  for (const Body<2>& body : bodies) {
    const int column = body.particles.state().find(name);
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      values.push_back(column < 0 ? 0.0 : body.particles.state()(column, p));
  }
  return values;
}

/// `Components` values of every particle, which `function` makes of its Cauchy stress
/// xx yy zz xy yz xz. Stresses are not kept: a snapshot holds no more than what it writes.
template <std::size_t Components, class Function>
std::vector<double> of_stress(const std::vector<Body<2>>& bodies, Function function)
{
  alignas(lane_alignment) double block[6 * lane_count];
  std::vector<double> values;
  values.reserve(Components * count(bodies));
  for (const Body<2>& body : bodies)
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      if (p % lane_count == 0)
        body.law->cauchy_stress(body.particles.state().block(p / lane_count), block);
      std::array<double, 6> stress;
      for (int k = 0; k < 6; ++k) stress[k] = block[k * lane_count + p % lane_count];
      const std::array<double, Components> made = function(stress);
      values.insert(values.end(), made.begin(), made.end());
    }
  return values;
}

std::array<double, 1> von_mises(const std::array<double, 6>& s)
{
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return {std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]))};
}

std::array<double, 1> pressure(const std::array<double, 6>& s)
{
  return {-(s[0] + s[1] + s[2]) / 3};
}

ParticleField make_field(Field field, const Formulation<2>& formulation)
{
  const std::vector<Body<2>>& bodies = formulation.bodies();
  switch (field) {
    case Field::velocity: {
      std::vector<double> values;
      values.reserve(3 * count(bodies));
      for (const Body<2>& body : bodies) {
        const int v = body.particles.motion().find("velocity");
        for (LocalIndex p = 0; p < body.particles.size(); ++p)
          values.insert(values.end(),
                        {body.particles.motion()(v, p), body.particles.motion()(v + 1, p), 0.0});
      }
      return {"velocity", "m/s", 3, std::move(values)};
    }
    case Field::stress:
      return {"stress", "Pa", 6, of_stress<6>(bodies, std::identity{})};
    case Field::von_mises:
      return {"von_mises", "Pa", 1, of_stress<1>(bodies, von_mises)};
    case Field::pressure:
      return {"pressure", "Pa", 1, of_stress<1>(bodies, pressure)};
    case Field::plastic_strain:
      return {"plastic_strain", "1", 1, state_column(bodies, "plastic_strain")};
    case Field::plastic_work:
      return {"plastic_work", "J", 1, state_column(bodies, "plastic_work")};
    case Field::material: {
      std::vector<std::int32_t> values;
      for (const Body<2>& body : bodies)
        values.insert(values.end(), body.particles.size(), body.material);
      return {"material", "1", 1, std::move(values)};
    }
    case Field::id: {
      std::vector<std::int64_t> values;
      for (const Body<2>& body : bodies)
        values.insert(values.end(), body.particles.ids().begin(), body.particles.ids().end());
      return {"id", "1", 1, std::move(values)};
    }
    case Field::rank:
      return {"rank", "1", 1,
              std::vector<std::int32_t>(formulation.particles(), formulation.decomposition().rank())};
  }
  throw InputError("unknown output field");
}

}  // namespace

Snapshots::Snapshots(const scene::Scene& scene, const std::filesystem::path& folder, MPI_Comm comm)
    : fields_(scene.output.fields),
      series_(comm, folder, scene.name, {.compress = scene.output.compress})
{
}

void Snapshots::write(const Formulation<2>& formulation, double strain)
{
  output::Snapshot snapshot;
  snapshot.time = formulation.time();
  snapshot.strain = strain;
  snapshot.step = formulation.steps();
  snapshot.position.reserve(3 * count(formulation.bodies()));
  for (const Body<2>& body : formulation.bodies())
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      snapshot.position.insert(snapshot.position.end(),
                               {body.particles.motion()(0, p), body.particles.motion()(1, p), 0.0});
  for (const Field field : fields_) snapshot.fields.push_back(make_field(field, formulation));
  series_.write(snapshot);
}

}  // namespace mpm
