#include <mpm/conditions/rigid_body.hpp>
#include <mpm/core/error.hpp>
#include <mpm/simulation/model.hpp>

#include <algorithm>
#include <cmath>

#include "placement.hpp"

namespace mpm {

namespace {

using micrograph::Lattice;
using micrograph::SpecimenModel;

/// Adds the particles of one body that lie in this rank's cells.
class BodyFiller {
 public:
  BodyFiller(Body<2>& body, const Layout& layout, const Decomposition<2>& decomposition,
             int per_cell)
      : body_(body), layout_(layout), decomposition_(decomposition), per_cell_(per_cell)
  {
  }

  /// The part of a box of locations outside of which this rank has no cells.
  IndexBox<2> nearby(const IndexBox<2>& locations) const
  {
    IndexBox<2> near = decomposition_.owned(decomposition_.rank());
    for (int d = 0; d < 2; ++d) {
      near.lower[d] = (near.lower[d] - layout_.padding[d]) * per_cell_;
      near.upper[d] = (near.upper[d] - layout_.padding[d]) * per_cell_;
    }
    return intersection(locations, near);
  }

  /// Whether a location lies in this rank's cells.
  bool is_home(int i, int j) const
  {
    const IndexVec<2> cell(cell_of_location(layout_, per_cell_, i, 0),
                           cell_of_location(layout_, per_cell_, j, 1));
    return decomposition_.owner_of_cell(cell) == decomposition_.rank();
  }

  void add(int i, int j, GlobalIndex id, const std::array<double, 2>& velocity)
  {
    if (!is_home(i, j)) return;
    ParticleStore& particles = body_.particles;
    const LocalIndex p = particles.add(id);
    ColumnGroup& motion = particles.motion();
    const int at = motion.find("position"), v = motion.find("velocity");
    motion(at, p) = (i + 0.5) * layout_.location_size[0];
    motion(at + 1, p) = (j + 0.5) * layout_.location_size[1];
    motion(v, p) = velocity[0];
    motion(v + 1, p) = velocity[1];
    motion(motion.find("mass"), p) = body_.density * layout_.particle_volume;
    particles.state()(0, p) = layout_.particle_volume;
    body_.law->initialise(particles.state(), p);
  }

 private:
  Body<2>& body_;
  const Layout& layout_;
  const Decomposition<2>& decomposition_;
  int per_cell_;
};

Body<2> empty_body(const scene::Material& material, int index, const scene::Scene& scene,
                   const Transfer<2>& transfer)
{
  auto law = law_of(material, scene);
  auto state = law->state_columns();
  ParticleStore particles(
      transfer.motion_columns(scene.numerics.update_order->remaps), std::move(state),
      {"velocity", "mass", "affine_velocity", "grid_velocity", "initial_volume", "plastic_work"});
  return {material.name, index, material.density(), std::move(law), std::move(particles)};
}

WallGrip grip_of(scene::Grip grip)
{
  return grip == scene::Grip::stick ? WallGrip::stick : WallGrip::slip;
}

void add_apparatus(const scene::Scene& scene, const SpecimenModel& specimen, const Layout& layout,
                   Model& model)
{
  const auto& loading = std::get<scene::Loading>(scene.motion);
  const ReactionBook book = scene.numerics.scheme->book;
  const auto wall = [&](int axis, bool upper, double position, const WallMotion& motion,
                        WallGrip grip) {
    auto made = std::make_unique<RigidWall<2>>(RigidWall<2>::Placement{axis, upper, position},
                                               motion, grip, book);
    RigidWall<2>* pointer = made.get();
    model.conditions.push_back(std::move(made));
    return pointer;
  };
  Apparatus apparatus;
  apparatus.axis = axis_of(loading.piston);
  const int axis = apparatus.axis, lateral = 1 - axis;
  const bool upper = upper_of(loading.piston);
  apparatus.length = specimen.size[axis];
  apparatus.area = specimen.size[lateral] * scene.numerics.thickness;
  double edge = upper ? 0 : specimen.size[axis];
  if (loading.load_cell)
    edge += (upper ? -1 : 1) * loading.load_cell->cells * layout.geometry.spacing[axis];
  const WallMotion inwards{upper ? -layout.piston.speed : layout.piston.speed,
                           layout.piston.ramp_time};
  apparatus.piston =
      wall(axis, upper, upper ? specimen.size[axis] : 0, inwards, grip_of(loading.grip));
  apparatus.edge = wall(axis, !upper, edge, {}, grip_of(loading.grip));
  for (int k = 0; k < 2; ++k)
    if (loading.lateral[k] != scene::Lateral::free)
      apparatus.lateral[k] =
          wall(lateral, k == 1, k == 1 ? specimen.size[lateral] : 0, {}, WallGrip::slip);
  model.apparatus = apparatus;
}

void add_sides(const scene::Scene& scene, const SpecimenModel& specimen, Model& model)
{
  const auto& motion = std::get<scene::FreeMotion>(scene.motion);
  for (int k = 0; k < 4; ++k) {
    if (motion.sides[k] == scene::Lateral::free) continue;
    const int axis = k / 2;
    const bool upper = k % 2 == 1;
    model.conditions.push_back(std::make_unique<RigidWall<2>>(
        RigidWall<2>::Placement{axis, upper, upper ? specimen.size[axis] : 0.0}, WallMotion{},
        motion.sides[k] == scene::Lateral::rigid ? WallGrip::stick : WallGrip::slip,
        scene.numerics.scheme->book));
  }
}

}  // namespace

Model make_model(const scene::Scene& scene, const SpecimenModel& specimen, const Layout& layout,
                 const Decomposition<2>& decomposition)
{
  Model model;
  model.transfer = make_transfer<2>(scene.numerics.shape_function, scene.numerics.scheme,
                                    specimen.particles_per_cell);
  const Lattice& lattice = specimen.lattice;
  const int per_cell = specimen.particles_per_cell;
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (std::ranges::find(lattice.material, std::int8_t(k)) == lattice.material.end()) continue;
    if (!material.law->deformable()) {
      const auto velocity = velocity_of(material);
      std::vector<Vec<2>> points;
      for (int j = 0; j < lattice.ny; ++j)
        for (int i = 0; i < lattice.nx; ++i)
          if (lattice(i, j) == std::int8_t(k))
            points.push_back(
                {(i + 0.5) * layout.location_size[0], (j + 0.5) * layout.location_size[1]});
      model.conditions.push_back(std::make_unique<RigidBody<2>>(
          std::move(points), Vec<2>(0.5 * layout.location_size[0], 0.5 * layout.location_size[1]),
          Vec<2>(velocity[0], velocity[1]), scene.numerics.scheme->book));
      continue;
    }
    Body<2>& body = model.bodies.emplace_back(empty_body(material, int(k), scene, *model.transfer));
    BodyFiller filler(body, layout, decomposition, per_cell);
    const IndexBox<2> near = filler.nearby({{0, 0}, {lattice.nx, lattice.ny}});
    LocalIndex count = 0;
    for (int j = near.lower[1]; j < near.upper[1]; ++j)
      for (int i = near.lower[0]; i < near.upper[0]; ++i)
        count += lattice(i, j) == std::int8_t(k) && filler.is_home(i, j);
    body.particles.reserve(count);
    for (int j = near.lower[1]; j < near.upper[1]; ++j)
      for (int i = near.lower[0]; i < near.upper[0]; ++i)
        if (lattice(i, j) == std::int8_t(k)) {
          const std::size_t location = std::size_t(j) * lattice.nx + i;
          filler.add(i, j, GlobalIndex(location), initial_velocity(scene, lattice, location));
        }
    body.particles.seal();
  }
  if (layout.load_cell) {
    const scene::Material material = load_cell_material(scene, layout.load_cell->density_ratio);
    Body<2>& body = model.bodies.emplace_back(
        empty_body(material, int(scene.materials.size()), scene, *model.transfer));
    BodyFiller filler(body, layout, decomposition, per_cell);
    const IndexBox<2>& box = layout.load_cell->locations;
    for_each_index(filler.nearby(box), [&](const IndexVec<2>& at) {
      filler.add(at[0], at[1], specimen.locations() + number_in(box, at), {0, 0});
    });
    body.particles.seal();
  }

  if (std::holds_alternative<scene::Loading>(scene.motion)) {
    add_apparatus(scene, specimen, layout, model);
    if (layout.load_cell) model.apparatus->load_cell_body = int(model.bodies.size()) - 1;
  } else {
    add_sides(scene, specimen, model);
  }
  return model;
}

}  // namespace mpm
