#include <mpm/core/error.hpp>
#include <mpm/lagrangian/location_cells.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/sides.hpp>
#include <mpm/simulation/body_contacts.hpp>
#include <mpm/simulation/fitted_surface.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/simulation/rigid_bodies.hpp>
#include <mpm/simulation/surface_marks.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpm {

namespace {

using micrograph::Lattice;
using micrograph::Specimen;

/// Adds the particles of one body that lie in this rank's cells.
template <int Dim>
class BodyFiller {
 public:
  BodyFiller(Body<Dim>& body, const Layout<Dim>& layout, const Decomposition<Dim>& decomposition)
      : body_(body),
        layout_(layout),
        decomposition_(decomposition),
        position_(body.particles.motion().find("position")),
        velocity_(body.particles.motion().find("velocity")),
        mass_(body.particles.motion().find("mass")),
        initial_position_(body.particles.motion().find("initial_position"))
  {
  }

  /// Whether a location lies in this rank's cells.
  bool is_home(const IndexVec<Dim>& at) const
  {
    return decomposition_.owner_of_cell(layout_.cell_of_location(at)) == decomposition_.rank();
  }

  std::array<double, Dim> place_of(const IndexVec<Dim>& at) const
  {
    std::array<double, Dim> place;
    for (int d = 0; d < Dim; ++d) place[std::size_t(d)] = (at[d] + 0.5) * layout_.location_size[d];
    return place;
  }

  void add(const IndexVec<Dim>& at, GlobalIndex id, const scene::PerAxis<double>& velocity)
  {
    const LocalIndex p = body_.particles.add(id);
    ColumnGroup& motion = body_.particles.motion();
    const std::array<double, Dim> place = place_of(at);
    for (int d = 0; d < Dim; ++d) {
      motion(position_ + d, p) = place[std::size_t(d)];
      motion(velocity_ + d, p) = velocity[std::size_t(d)];
      if (initial_position_ >= 0) motion(initial_position_ + d, p) = place[std::size_t(d)];
    }
    motion(mass_, p) = body_.density * layout_.particle_volume;
    set_domain_at_rest<Dim>(motion, p, 0.5 * layout_.location_size);
    LocationCells<Dim>::initialise(motion, p);
    body_.particles.state()(0, p) = layout_.particle_volume;
    body_.law->initialise(body_.particles.state(), p);
  }

 private:
  Body<Dim>& body_;
  const Layout<Dim>& layout_;
  const Decomposition<Dim>& decomposition_;
  int position_, velocity_, mass_, initial_position_;
};

template <int Dim>
Body<Dim> empty_body(const scene::Material& material, int index, const scene::Scene& scene,
                     int particles_per_cell, const Loads<Dim>& loads)
{
  auto law = law_of<Dim>(material, scene);
  ParticleStore particles = empty_store(scene, particles_per_cell, *law, loads);
  return {material.name, index, material.density(), std::move(law), std::move(particles)};
}

template <int Dim>
void fill_body(Body<Dim>& body, const scene::Scene& scene, const Lattice<Dim>& lattice,
               const Layout<Dim>& layout, const Decomposition<Dim>& decomposition)
{
  BodyFiller<Dim> filler(body, layout, decomposition);
  // Velocities stand before or after the stresses of t = 0 (leap-frog).
  const double moment = -stress_moment_of(scene.numerics) * time_step_of(layout).first();
  const auto velocity_of = [&](const IndexVec<Dim>& at, int shape) {
    scene::PerAxis<double> velocity{};
    if (const auto& formulas = scene.specimen.initial_velocity)
      for (std::size_t d = 0; d < std::size_t(Dim); ++d)
        velocity[d] = (*formulas)[d](filler.place_of(at), moment);
    else if (shape >= 0)
      velocity = scene.specimen.shapes[std::size_t(shape)].velocity;
    return velocity;
  };
  const auto visit_home = [&](const auto& visit) {
    std::size_t place = 0;
    for_each_index(lattice.part, [&](const IndexVec<Dim>& at) {
      if (lattice.material[place] == body.material && filler.is_home(at)) visit(at, place);
      ++place;
    });
  };
  LocalIndex count = 0;
  visit_home([&](const IndexVec<Dim>&, std::size_t) { ++count; });
  body.particles.reserve(count);
  visit_home([&](const IndexVec<Dim>& at, std::size_t place) {
    const int shape = lattice.shape.empty() ? -1 : lattice.shape[place];
    filler.add(at, lattice.id(at), velocity_of(at, shape));
  });
  body.particles.seal();
}

WallGrip grip_of(scene::Grip grip)
{
  switch (grip) {
    case scene::Grip::slip:
      return WallGrip::slip;
    case scene::Grip::contact:
      return WallGrip::contact;
    default:
      return WallGrip::stick;
  }
}

template <int Dim>
WallStiffness<Dim> wall_stiffness(const scene::Scene& scene, const Layout<Dim>& layout)
{
  return {contact_stiffness(scene.numerics), layout.location_size};
}

template <int Dim>
void add_apparatus(const scene::Scene& scene, const Specimen<Dim>& specimen,
                   const Layout<Dim>& layout, Model<Dim>& model)
{
  const auto& loading = std::get<scene::Loading>(scene.motion);
  const WallGrip grip = grip_of(loading.grip);
  const auto wall = [&](int axis, bool upper, double position, const WallMotion& motion) {
    auto made = std::make_unique<RigidWall<Dim>>(WallPlacement{axis, upper, position}, motion, grip,
                                                 reaction_book(scene.numerics),
                                                 wall_stiffness(scene, layout), loading.friction);
    RigidWall<Dim>* pointer = made.get();
    model.slots.conditions.push_back(std::move(made));
    return pointer;
  };
  Apparatus<Dim> apparatus;
  const int axis = apparatus.axis = axis_of(loading.piston);
  const bool upper = upper_of(loading.piston);
  apparatus.length = specimen.size()[axis];
  apparatus.area = Dim == 2 ? scene.numerics.thickness : 1.0;
  for (int d = 0; d < Dim; ++d)
    if (d != axis) apparatus.area *= specimen.size()[d];
  double edge = upper ? 0 : apparatus.length;
  if (loading.load_cell)
    edge += (upper ? -1 : 1) * loading.load_cell->cells * layout.geometry.spacing[axis];
  const WallMotion inwards{upper ? -layout.piston.speed : layout.piston.speed,
                           layout.piston.ramp_time};
  apparatus.piston = wall(axis, upper, upper ? apparatus.length : 0, inwards);
  apparatus.edge = wall(axis, !upper, edge, {});
  apparatus.at_rest.push_back(apparatus.edge);
  if (layout.load_cell) apparatus.load_cell_body = int(model.bodies.size()) - 1;
  model.apparatus = std::move(apparatus);
}

template <int Dim>
WallPlacement placement_of(const Specimen<Dim>& specimen, int axis, bool upper)
{
  return {axis, upper, upper ? specimen.size()[axis] : 0.0};
}

/// What acts at the sides of the grid.
template <int Dim>
void add_sides(const scene::Scene& scene, const Specimen<Dim>& specimen, const Layout<Dim>& layout,
               Model<Dim>& model)
{
  for (int axis = 0; axis < Dim; ++axis)
    for (const bool upper : {false, true}) {
      const auto side = scene::side_of(scene, axis, upper);
      if (!side) continue;
      auto condition =
          make_side<Dim>(**side, {placement_of(specimen, axis, upper), model.apparatus.has_value(),
                                  reaction_book(scene.numerics)});
      if (!condition) continue;
      const auto* wall = dynamic_cast<const RigidWall<Dim>*>(condition.get());
      if (model.apparatus && wall) model.apparatus->at_rest.push_back(wall);
      model.slots.conditions.push_back(std::move(condition));
    }
  const auto* free = std::get_if<scene::FreeMotion>(&scene.motion);
  if (!free) return;
  for (const scene::MovingSide& side : free->moving_sides)
    model.slots.conditions.push_back(std::make_unique<RigidWall<Dim>>(
        placement_of(specimen, axis_of(side.side), upper_of(side.side)),
        WallMotion{.table = side.table}, grip_of(side.grip), reaction_book(scene.numerics),
        wall_stiffness(scene, layout), side.friction));
}

/// Collective. Throws InputError on every rank for a load that finds no particle.
template <int Dim>
void mark_loaded(const scene::Scene& scene, const Specimen<Dim>& specimen,
                 const Layout<Dim>& layout, MPI_Comm comm, Model<Dim>& model)
{
  const std::vector<SurfaceMark<Dim>> marks = model.slots.loads.marks();
  const std::vector<GlobalIndex> counts =
      mark_surfaces<Dim>(comm, marks, specimen.count(), layout, model.bodies);
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (counts[k] == 0)
      throw InputError(fmt::format(
          "{}: loads[{}] acts on nothing (no particle of the surface seen from its side lies "
          "within its box). Move or enlarge loads[{}].within.",
          scene.file.string(), marks[k].load, marks[k].load));
}

}  // namespace

template <int Dim>
Loads<Dim> loads_of(const scene::Scene& scene)
{
  std::vector<std::unique_ptr<Load<Dim>>> loads;
  for (const scene::Load& load : scene.loads)
    loads.push_back(make_load<Dim>(*load.kind, load.values, int(loads.size())));
  return Loads<Dim>(std::move(loads));
}

template <int Dim>
ParticleStore empty_store(const scene::Scene& scene, int particles_per_cell, const Law<Dim>& law,
                          const Loads<Dim>& loads)
{
  std::vector<Column> motion = motion_columns<Dim>(scene.numerics, particles_per_cell, law);
  if (scene.exact_solution || loads.need_initial_position())
    motion.push_back({"initial_position", Dim, "m"});
  std::vector<std::string> zero_in_padding{"velocity",      "mass",           "affine_velocity",
                                           "grid_velocity", "initial_volume", "plastic_work"};
  for (const SurfaceMark<Dim>& mark : loads.marks()) {
    motion.push_back({mark.column(), 1, "m2"});
    zero_in_padding.push_back(mark.column());
  }
  return {std::move(motion), law.state_columns(), std::move(zero_in_padding)};
}

template <int Dim>
Model<Dim> make_model(const scene::Scene& scene, const Specimen<Dim>& specimen,
                      const Layout<Dim>& layout, const Decomposition<Dim>& decomposition)
{
  Model<Dim> model;
  model.slots.loads = loads_of<Dim>(scene);
  const Lattice<Dim> lattice = specimen.lattice(nearby(specimen.whole(), layout, decomposition));
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (specimen.particles_of_material()[k] == 0) continue;
    if (material.law->deformable()) {
      model.bodies.push_back(
          empty_body<Dim>(material, int(k), scene, layout.per_cell, model.slots.loads));
      fill_body(model.bodies.back(), scene, lattice, layout, decomposition);
      continue;
    }
    add_rigid_body(scene, int(k), specimen, layout, decomposition, model);
  }
  if (layout.load_cell) {
    const scene::Material material = load_cell_material(scene, layout.load_cell->density_ratio);
    model.bodies.push_back(empty_body<Dim>(material, int(scene.materials.size()), scene,
                                           layout.per_cell, model.slots.loads));
    BodyFiller<Dim> filler(model.bodies.back(), layout, decomposition);
    const IndexBox<Dim>& box = layout.load_cell->locations;
    const auto visit_home = [&](const auto& visit) {
      for_each_index(nearby(box, layout, decomposition), [&](const IndexVec<Dim>& at) {
        if (filler.is_home(at)) visit(at);
      });
    };
    LocalIndex count = 0;
    visit_home([&](const IndexVec<Dim>&) { ++count; });
    model.bodies.back().particles.reserve(count);
    visit_home([&](const IndexVec<Dim>& at) {
      filler.add(at, specimen.locations() + number_in(box, at), {});
    });
    model.bodies.back().particles.seal();
  }
  model.offsets =
      surface_offsets(scene, specimen, layout, nearby(specimen.whole(), layout, decomposition));
  add_contact(scene, layout, model);
  if (std::holds_alternative<scene::Loading>(scene.motion))
    add_apparatus(scene, specimen, layout, model);
  add_sides(scene, specimen, layout, model);
  mark_loaded(scene, specimen, layout, decomposition.comm(), model);
  return model;
}

template Model<2> make_model(const scene::Scene&, const Specimen<2>&, const Layout<2>&,
                             const Decomposition<2>&);
template Model<3> make_model(const scene::Scene&, const Specimen<3>&, const Layout<3>&,
                             const Decomposition<3>&);
template Loads<2> loads_of<2>(const scene::Scene&);
template Loads<3> loads_of<3>(const scene::Scene&);
template ParticleStore empty_store(const scene::Scene&, int, const Law<2>&, const Loads<2>&);
template ParticleStore empty_store(const scene::Scene&, int, const Law<3>&, const Loads<3>&);

}  // namespace mpm
