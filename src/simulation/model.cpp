#include <mpm/conditions/rigid_body.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>

#include <algorithm>
#include <cmath>

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
        mass_(body.particles.motion().find("mass"))
  {
  }

  /// Whether a location lies in this rank's cells.
  bool is_home(const IndexVec<Dim>& at) const
  {
    return decomposition_.owner_of_cell(layout_.cell_of_location(at)) == decomposition_.rank();
  }

  void add(const IndexVec<Dim>& at, GlobalIndex id, const scene::PerAxis<double>& velocity)
  {
    const LocalIndex p = body_.particles.add(id);
    ColumnGroup& motion = body_.particles.motion();
    for (int d = 0; d < Dim; ++d) {
      motion(position_ + d, p) = (at[d] + 0.5) * layout_.location_size[d];
      motion(velocity_ + d, p) = velocity[std::size_t(d)];
    }
    motion(mass_, p) = body_.density * layout_.particle_volume;
    body_.particles.state()(0, p) = layout_.particle_volume;
    body_.law->initialise(body_.particles.state(), p);
  }

 private:
  Body<Dim>& body_;
  const Layout<Dim>& layout_;
  const Decomposition<Dim>& decomposition_;
  int position_, velocity_, mass_;
};

/// The part of a box of locations outside of which this rank has no cells.
template <int Dim>
IndexBox<Dim> nearby(const IndexBox<Dim>& locations, const Layout<Dim>& layout,
                     const Decomposition<Dim>& decomposition)
{
  IndexBox<Dim> near = decomposition.owned(decomposition.rank());
  near.lower = (near.lower - layout.padding) * layout.per_cell;
  near.upper = (near.upper - layout.padding) * layout.per_cell;
  return intersection(locations, near);
}

template <int Dim>
Body<Dim> empty_body(const scene::Material& material, int index, const scene::Scene& scene,
                     const typename UpdatedLagrangian<Dim>::Setup& setup)
{
  auto law = law_of<Dim>(material, scene);
  ParticleStore particles = empty_store(*setup.transfer, *setup.order, *law);
  return {material.name, index, material.density(), std::move(law), std::move(particles)};
}

template <int Dim>
void fill_body(Body<Dim>& body, const scene::Scene& scene, const Lattice<Dim>& lattice,
               const Layout<Dim>& layout, const Decomposition<Dim>& decomposition)
{
  constexpr scene::PerAxis<double> at_rest{};
  BodyFiller<Dim> filler(body, layout, decomposition);
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
    filler.add(at, lattice.id(at),
               shape < 0 ? at_rest : scene.specimen.shapes[std::size_t(shape)].velocity);
  });
  body.particles.seal();
}

/// Of all ranks, each of which looks at its slab. Collective.
template <int Dim>
std::vector<Vec<Dim>> points_of(int material, const Specimen<Dim>& specimen,
                                const Layout<Dim>& layout, MPI_Comm comm)
{
  const IndexBox<Dim> own = micrograph::slab(specimen.whole(), rank_of(comm), ranks_of(comm));
  const Lattice<Dim> lattice = specimen.lattice(own);
  std::vector<double> coordinates;
  std::size_t place = 0;
  for_each_index(own, [&](const IndexVec<Dim>& at) {
    if (lattice.material[place++] != material) return;
    for (int d = 0; d < Dim; ++d) coordinates.push_back((at[d] + 0.5) * layout.location_size[d]);
  });
  const std::vector<double> all = joined_over_ranks(comm, coordinates);
  std::vector<Vec<Dim>> points(all.size() / Dim);
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int d = 0; d < Dim; ++d) points[k][d] = all[k * Dim + d];
  return points;
}

template <int Dim>
void add_apparatus(const scene::Scene& scene, const Specimen<Dim>& specimen,
                   const Layout<Dim>& layout, Model<Dim>& model)
{
  const auto& loading = std::get<scene::Loading>(scene.motion);
  const WallGrip grip = loading.grip == scene::Grip::stick ? WallGrip::stick : WallGrip::slip;
  const auto wall = [&](int axis, bool upper, double position, const WallMotion& motion) {
    auto made =
        std::make_unique<RigidWall<Dim>>(typename RigidWall<Dim>::Placement{axis, upper, position},
                                         motion, grip, scene.numerics.scheme->book);
    RigidWall<Dim>* pointer = made.get();
    model.setup.slots.conditions.push_back(std::move(made));
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
  if (layout.load_cell) apparatus.load_cell_body = int(model.setup.bodies.size()) - 1;
  model.apparatus = std::move(apparatus);
}

/// Rigid and symmetric sides of the grid. Beside a piston's travel both only keep particles in.
template <int Dim>
void add_sides(const scene::Scene& scene, const Specimen<Dim>& specimen, Model<Dim>& model)
{
  for (int axis = 0; axis < Dim; ++axis)
    for (const bool upper : {false, true}) {
      const auto side = side_of(scene, axis, upper);
      if (!side || *side == scene::Lateral::free || *side == scene::Lateral::periodic) continue;
      const bool sticks = *side == scene::Lateral::rigid && !model.apparatus;
      auto wall = std::make_unique<RigidWall<Dim>>(
          typename RigidWall<Dim>::Placement{axis, upper, upper ? specimen.size()[axis] : 0.0},
          WallMotion{}, sticks ? WallGrip::stick : WallGrip::slip, scene.numerics.scheme->book);
      if (model.apparatus) model.apparatus->at_rest.push_back(wall.get());
      model.setup.slots.conditions.push_back(std::move(wall));
    }
}

}  // namespace

template <int Dim>
ParticleStore empty_store(const Transfer<Dim>& transfer, const UpdateOrder<Dim>& order,
                          const Law<Dim>& law)
{
  return {
      transfer.motion_columns(order.needs().remap),
      law.state_columns(),
      {"velocity", "mass", "affine_velocity", "grid_velocity", "initial_volume", "plastic_work"}};
}

template <int Dim>
Model<Dim> make_model(const scene::Scene& scene, const Specimen<Dim>& specimen,
                      const Layout<Dim>& layout, const Decomposition<Dim>& decomposition)
{
  Model<Dim> model;
  auto& setup = model.setup;
  setup.transfer = make_transfer<Dim>(scene.numerics, layout.per_cell);
  setup.order = make_update_order<Dim>(scene.numerics.update_order->kind);
  setup.mass_cut = 1e-24 * layout.largest_particle_mass;
  const Lattice<Dim> lattice = specimen.lattice(nearby(specimen.whole(), layout, decomposition));
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (specimen.particles_of_material()[k] == 0) continue;
    if (material.law->deformable()) {
      setup.bodies.push_back(empty_body<Dim>(material, int(k), scene, setup));
      fill_body(setup.bodies.back(), scene, lattice, layout, decomposition);
      continue;
    }
    std::array<WallMotion, Dim> motion;
    for (int d = 0; d < Dim; ++d)
      motion[d].speed = material.values.vector("velocity")[std::size_t(d)];
    setup.slots.conditions.push_back(std::make_unique<RigidBody<Dim>>(
        points_of(int(k), specimen, layout, decomposition.comm()), 0.5 * layout.location_size,
        motion, scene.numerics.scheme->book));
  }
  if (layout.load_cell) {
    const scene::Material material = load_cell_material(scene, layout.load_cell->density_ratio);
    setup.bodies.push_back(empty_body<Dim>(material, int(scene.materials.size()), scene, setup));
    BodyFiller<Dim> filler(setup.bodies.back(), layout, decomposition);
    const IndexBox<Dim>& box = layout.load_cell->locations;
    for_each_index(nearby(box, layout, decomposition), [&](const IndexVec<Dim>& at) {
      if (filler.is_home(at)) filler.add(at, specimen.locations() + number_in(box, at), {});
    });
    setup.bodies.back().particles.seal();
  }
  if (std::holds_alternative<scene::Loading>(scene.motion))
    add_apparatus(scene, specimen, layout, model);
  add_sides(scene, specimen, model);
  return model;
}

template Model<2> make_model(const scene::Scene&, const Specimen<2>&, const Layout<2>&,
                             const Decomposition<2>&);
template Model<3> make_model(const scene::Scene&, const Specimen<3>&, const Layout<3>&,
                             const Decomposition<3>&);
template ParticleStore empty_store(const Transfer<2>&, const UpdateOrder<2>&, const Law<2>&);
template ParticleStore empty_store(const Transfer<3>&, const UpdateOrder<3>&, const Law<3>&);

}  // namespace mpm
