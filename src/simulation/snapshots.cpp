#include <mpm/core/error.hpp>
#include <mpm/simulation/snapshots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace mpm {

namespace {

using output::ParticleField;
using scene::Field;

template <int Dim>
std::size_t count(const std::vector<Body<Dim>>& bodies)
{
  std::size_t particles = 0;
  for (const Body<Dim>& body : bodies) particles += std::size_t(body.particles.size());
  return particles;
}

/// A vector of the motion columns with three components; 0 along z in the plane.
template <int Dim>
std::vector<double> vectors(const std::vector<Body<Dim>>& bodies, const std::string& name)
{
  std::vector<double> values;
  values.reserve(3 * count(bodies));
  for (const Body<Dim>& body : bodies) {
    const int column = body.particles.motion().find(name);
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      for (int d = 0; d < 3; ++d)
        values.push_back(d < Dim ? body.particles.motion()(column + d, p) : 0.0);
  }
  return values;
}

/// Column of a state field; zeros for bodies that do not have it.
template <int Dim>
std::vector<double> state_column(const std::vector<Body<Dim>>& bodies, const std::string& name)
{
  std::vector<double> values;
  values.reserve(count(bodies));
  for (const Body<Dim>& body : bodies) {
    const int column = body.particles.state().find(name);
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      values.push_back(column < 0 ? 0.0 : body.particles.state()(column, p));
  }
  return values;
}

/// `Components` values of every particle, which `function` makes of its Cauchy stress
/// xx yy zz xy yz xz. Stresses are not kept: a snapshot holds no more than what it writes.
template <std::size_t Components, int Dim, class Function>
std::vector<double> of_stress(const std::vector<Body<Dim>>& bodies, Function function)
{
  alignas(lane_alignment) double block[6 * lane_count];
  std::vector<double> values;
  values.reserve(Components * count(bodies));
  for (const Body<Dim>& body : bodies)
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

/// J of every particle.
template <int Dim>
std::vector<double> volume_ratios(const std::vector<Body<Dim>>& bodies)
{
  std::vector<double> values;
  values.reserve(count(bodies));
  for (const Body<Dim>& body : bodies) {
    Lanes block;
    for (LocalIndex p = 0; p < body.particles.size(); ++p) {
      if (p % lane_count == 0)
        block = body.law->volume_ratio(body.particles.state().block(p / lane_count));
      values.push_back(block[p % lane_count]);
    }
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

template <int Dim>
ParticleField make_field(Field field, const Formulation<Dim>& formulation)
{
  const std::vector<Body<Dim>>& bodies = formulation.bodies();
  switch (field) {
    case Field::velocity:
      return {"velocity", "m/s", 3, vectors(bodies, "velocity")};
    case Field::stress:
      return {"stress", "Pa", 6, of_stress<6>(bodies, std::identity{})};
    case Field::von_mises:
      return {"von_mises", "Pa", 1, of_stress<1>(bodies, von_mises)};
    case Field::pressure:
      return {"pressure", "Pa", 1, of_stress<1>(bodies, pressure)};
    case Field::volume_ratio:
      return {"volume_ratio", "1", 1, volume_ratios(bodies)};
    case Field::plastic_strain:
      return {"plastic_strain", "1", 1, state_column(bodies, "plastic_strain")};
    case Field::plastic_work:
      return {"plastic_work", "J", 1, state_column(bodies, "plastic_work")};
    case Field::material: {
      std::vector<std::int32_t> values;
      for (const Body<Dim>& body : bodies)
        values.insert(values.end(), body.particles.size(), body.material);
      return {"material", "1", 1, std::move(values)};
    }
    case Field::id: {
      std::vector<std::int64_t> values;
      for (const Body<Dim>& body : bodies)
        values.insert(values.end(), body.particles.ids().begin(), body.particles.ids().end());
      return {"id", "1", 1, std::move(values)};
    }
    case Field::rank:
      return {
          "rank", "1", 1,
          std::vector<std::int32_t>(formulation.particles(), formulation.decomposition().rank())};
  }
  throw InputError("unknown output field");
}

}  // namespace

template <int Dim>
std::vector<double> snapshot_moments(const Preparation<Dim>& preparation)
{
  const scene::Scene& scene = preparation.scene;
  std::vector<double> times = scene.output.snapshot_times;
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion)) {
    const double length = preparation.specimen.size()[axis_of(loading->piston)];
    for (const double strain : scene.output.snapshot_strains)
      times.push_back(time_of_strain(preparation.layout.piston, length, strain));
  }
  std::ranges::sort(times);
  return times;
}

template <int Dim>
output::Snapshot snapshot_of(const Preparation<Dim>& preparation, Formulation<Dim>& formulation,
                             double strain)
{
  output::Snapshot snapshot;
  snapshot.time = formulation.time();
  snapshot.strain = strain;
  snapshot.step = formulation.steps();
  snapshot.particle_volume = preparation.layout.particle_volume;
  snapshot.position = vectors(formulation.bodies(), "position");
  for (const Field field : preparation.scene.output.fields)
    snapshot.fields.push_back(make_field(field, formulation));
  return snapshot;
}

template <int Dim>
Snapshots<Dim>::Snapshots(const Preparation<Dim>& preparation, const std::filesystem::path& folder)
    : preparation_(preparation),
      series_(preparation.comm, folder, preparation.scene.name,
              {.compress = preparation.scene.output.compress}),
      moments_(snapshot_moments(preparation))
{
}

template <int Dim>
void Snapshots<Dim>::look(const typename Observer<Dim>::State& state)
{
  Formulation<Dim>& formulation = state.formulation;
  looked_ = formulation.time();
  if (!pass_moments()) return;
  formulation.check();
  series_.write(snapshot_of(preparation_, formulation, state.strain));
}

/// Whether any has come.
template <int Dim>
bool Snapshots<Dim>::pass_moments()
{
  const std::size_t before = next_;
  while (next_ < moments_.size() && looked_ >= moments_[next_] * (1 - 1e-9)) ++next_;
  return next_ > before;
}

template <int Dim>
void Snapshots<Dim>::kept()
{
  next_when_kept_ = next_;
  written_when_kept_ = series_.written();
}

template <int Dim>
void Snapshots<Dim>::went_back(const GoingBack&)
{
  next_ = next_when_kept_;
  series_.cut(written_when_kept_);
}

template <int Dim>
void Snapshots<Dim>::archive(Archive& archive)
{
  archive.value("looked", looked_);
  series_.archive(archive);
  if (!archive.is_loading()) return;
  next_ = 0;
  pass_moments();
}

template std::vector<double> snapshot_moments(const Preparation<2>&);
template std::vector<double> snapshot_moments(const Preparation<3>&);
template output::Snapshot snapshot_of(const Preparation<2>&, Formulation<2>&, double);
template output::Snapshot snapshot_of(const Preparation<3>&, Formulation<3>&, double);

template class Snapshots<2>;
template class Snapshots<3>;

}  // namespace mpm
