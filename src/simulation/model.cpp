#include <mpm/conditions/rigid_body.hpp>
#include <mpm/core/error.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/transfer/scheme.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

using micrograph::Lattice;
using micrograph::SpecimenModel;

/// Cells around everything, so that stencils of particles at the outermost place lie on the grid.
constexpr LocalIndex ghost_cells = 2;
/// Share of the specimen's width left empty beside a free lateral edge.
constexpr double free_margin = 0.25;
/// Length of the default smooth start in crossings of the specimen by the fastest wave. Waves in
/// wood run at half of that speed or less: two to four of its crossings, so that piston and edge
/// feel about the same force while the cell walls are still elastic.
constexpr double crossings_of_start = 8;

int axis_of(scene::Side side) { return side == scene::Side::left || side == scene::Side::right ? 0 : 1; }
bool upper_of(scene::Side side) { return side == scene::Side::right || side == scene::Side::top; }

/// Margins left, right, bottom, top in m, with room for free edges where none is given.
std::array<double, 4> margins(const scene::Scene& scene, const std::array<double, 2>& size)
{
  std::array<double, 4> margin = scene.grid.margin;
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion)) {
    const int lateral = 1 - axis_of(loading->piston);
    for (int k = 0; k < 2; ++k)
      if (loading->lateral[k] == scene::Lateral::free && margin[2 * lateral + k] == 0)
        margin[2 * lateral + k] = free_margin * size[lateral];
  }
  return margin;
}

std::array<double, 2> initial_velocity(const scene::Scene& scene, const Lattice& lattice,
                                       std::size_t location)
{
  if (lattice.shape.empty() || lattice.shape[location] < 0) return {0, 0};
  return scene.specimen.shapes[lattice.shape[location]].velocity;
}

double fastest(const std::array<double, 2>& v)
{
  return std::max(std::abs(v[0]), std::abs(v[1]));
}

ReactionBook book_of(const scene::Numerics& numerics)
{
  return numerics.scheme == scene::TransferScheme::flip ? ReactionBook::increments
                                                        : ReactionBook::velocities;
}

/// The load cell: elastic like the first deformable material, stiffer and denser by the same
/// ratio, so that waves run through it as fast as through the wood.
scene::Material load_cell_material(const scene::Scene& scene, double ratio)
{
  const auto first = std::ranges::find_if(
      scene.materials, [](const scene::Material& m) { return m.law != scene::Law::rigid; });
  scene::Material material;
  material.name = "load_cell";
  material.law = scene::Law::isotropic;
  material.density = ratio * first->density;
  material.youngs_modulus = ratio * first->youngs_modulus;
  material.poisson_ratio = first->poisson_ratio;
  return material;
}

}  // namespace

double default_cfl(const scene::Numerics& numerics)
{
  if (numerics.cfl) return *numerics.cfl;
  // Half of the measured limits or less; without re-mapping the limit at free edges is lower.
  if (numerics.update_order == scene::UpdateOrder::usl) return 0.4;
  return numerics.shape_function == scene::ShapeFunction::quadratic ? 1.0 : 0.6;
}

UpdateOrderKind update_order_of(const scene::Scene& scene)
{
  switch (scene.numerics.update_order) {
    case scene::UpdateOrder::musl: return UpdateOrderKind::musl;
    case scene::UpdateOrder::usf: return UpdateOrderKind::usf;
    case scene::UpdateOrder::usl: return UpdateOrderKind::usl;
  }
  throw InputError("unknown update order");
}

std::unique_ptr<Transfer<2>> make_transfer(const scene::Numerics& numerics, int particles_per_cell)
{
  const auto shape = [&] {
    switch (numerics.shape_function) {
      case scene::ShapeFunction::linear: return ShapeKind::linear;
      case scene::ShapeFunction::gimp: return ShapeKind::gimp;
      case scene::ShapeFunction::quadratic: return ShapeKind::quadratic;
    }
    throw InputError("unknown shape function");
  };
  const auto scheme = [&] {
    switch (numerics.scheme) {
      case scene::TransferScheme::flip: return SchemeKind::flip;
      case scene::TransferScheme::pic: return SchemeKind::pic;
      case scene::TransferScheme::apic: return SchemeKind::apic;
      case scene::TransferScheme::tpic: return SchemeKind::tpic;
    }
    throw InputError("unknown transfer scheme");
  };
  return make_transfer<2>(shape(), scheme(), particles_per_cell);
}

Decomposition<2> make_decomposition(MPI_Comm comm, const scene::Scene& scene, const Layout& layout)
{
  std::optional<int> keep_whole;
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion))
    keep_whole = axis_of(loading->piston);
  return {comm, layout.geometry,
          IndexVec<2>(scene.numerics.ranks[0], scene.numerics.ranks[1]), layout.layer_weights,
          keep_whole};
}

Layout make_layout(const scene::Scene& scene, const SpecimenModel& specimen)
{
  Layout layout;
  const int per_cell = specimen.particles_per_cell;
  std::array<LocalIndex, 2> before{ghost_cells, ghost_cells}, after{ghost_cells, ghost_cells};
  const auto margin = margins(scene, specimen.size);
  const auto* loading = std::get_if<scene::Loading>(&scene.motion);
  for (int d = 0; d < 2; ++d) {
    const double h = specimen.size[d] / specimen.cells[d];
    layout.geometry.spacing[d] = h;
    layout.location_size[d] = h / per_cell;
    before[d] += LocalIndex(std::ceil(margin[2 * d] / h - 1e-9));
    after[d] += LocalIndex(std::ceil(margin[2 * d + 1] / h - 1e-9));
  }
  const int nx = specimen.lattice.nx, ny = specimen.lattice.ny;
  if (loading && loading->load_cell) {
    const int axis = axis_of(loading->piston);
    const LocalIndex cells = loading->load_cell->cells;
    (upper_of(loading->piston) ? before : after)[axis] += cells;
    Layout::LoadCellBox box{{{0, 0}, {nx, ny}}, loading->load_cell->stiffness_ratio};
    const LocalIndex layers = cells * per_cell;
    if (upper_of(loading->piston)) {
      box.locations.lower[axis] = -layers;
      box.locations.upper[axis] = 0;
    } else {
      box.locations.lower[axis] = axis == 0 ? nx : ny;
      box.locations.upper[axis] += layers;
    }
    layout.load_cell = box;
  }
  // The specimen's lower left corner is the origin of coordinates.
  for (int d = 0; d < 2; ++d) {
    layout.padding[d] = before[d];
    layout.specimen_lower[d] = 0;
    layout.geometry.origin[d] = -before[d] * layout.geometry.spacing[d];
    layout.geometry.nodes[d] = before[d] + specimen.cells[d] + after[d] + 1;
    layout.layer_weights[d].assign(layout.geometry.nodes[d], 0.0);
  }

  layout.particle_volume =
      layout.location_size[0] * layout.location_size[1] * scene.numerics.thickness;
  layout.largest_particle_mass = 0;
  layout.wave_speed = 0;
  layout.largest_speed = loading ? loading->speed : 0;
  std::vector<char> used(scene.materials.size(), 0);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const std::int8_t material = specimen.lattice(i, j);
      if (material == Lattice::empty) continue;
      used[material] = 1;
      if (scene.materials[material].law == scene::Law::rigid) continue;
      layout.layer_weights[0][before[0] + i / per_cell] += 1;
      layout.layer_weights[1][before[1] + j / per_cell] += 1;
      layout.largest_speed =
          std::max(layout.largest_speed, fastest(initial_velocity(scene, specimen.lattice,
                                                                  std::size_t(j) * nx + i)));
    }
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (material.law == scene::Law::rigid) {
      if (used[k]) layout.largest_speed = std::max(layout.largest_speed, fastest(material.velocity));
      continue;
    }
    if (!used[k]) continue;
    layout.largest_particle_mass =
        std::max(layout.largest_particle_mass, material.density * layout.particle_volume);
    layout.wave_speed =
        std::max(layout.wave_speed, make_law(material, scene.numerics.plane)->wave_speed());
  }
  if (layout.load_cell) {
    const scene::Material cell = load_cell_material(scene, layout.load_cell->density_ratio);
    layout.largest_particle_mass =
        std::max(layout.largest_particle_mass, cell.density * layout.particle_volume);
    layout.wave_speed =
        std::max(layout.wave_speed, make_law(cell, scene.numerics.plane)->wave_speed());
  }
  layout.cfl = default_cfl(scene.numerics);
  if (loading) {
    const int axis = axis_of(loading->piston);
    const double crossing = specimen.size[axis] / layout.wave_speed;
    layout.piston = {loading->speed, loading->ramp_time.value_or(crossings_of_start * crossing)};
    layout.end_time = time_of_strain(scene, specimen, layout.piston, loading->strain);
  } else {
    layout.end_time = std::get<scene::FreeMotion>(scene.motion).end_time;
  }
  return layout;
}

double time_of_strain(const scene::Scene& scene, const SpecimenModel& specimen,
                      const WallMotion& piston, double strain)
{
  const int axis = axis_of(std::get<scene::Loading>(scene.motion).piston);
  return strain > 0 ? piston.time_of(strain * specimen.size[axis]) : 0.0;
}

namespace {

/// Adds the particles of one body that lie in this rank's cells.
class BodyFiller {
 public:
  BodyFiller(Body<2>& body, const Layout& layout, const Decomposition<2>& decomposition,
             int per_cell)
      : body_(body),
        layout_(layout),
        home_(decomposition.owned(decomposition.rank())),
        per_cell_(per_cell)
  {
  }

  void add(int i, int j, GlobalIndex id, const std::array<double, 2>& velocity)
  {
    const auto cell = [&](int location, int d) {
      const int c = location >= 0 ? location / per_cell_ : (location + 1) / per_cell_ - 1;
      return layout_.padding[d] + c;
    };
    if (!home_.contains(IndexVec<2>(cell(i, 0), cell(j, 1)))) return;
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
  IndexBox<2> home_;
  int per_cell_;
};

Body<2> empty_body(const scene::Material& material, int index, const scene::Scene& scene,
                   const Transfer<2>& transfer)
{
  auto law = make_law(material, scene.numerics.plane);
  auto state = law->state_columns();
  const bool musl = scene.numerics.update_order == scene::UpdateOrder::musl;
  ParticleStore particles(transfer.motion_columns(musl), std::move(state),
                          {"velocity", "mass", "affine_velocity", "grid_velocity",
                           "initial_volume", "plastic_work"});
  return {material.name, index, material.density, std::move(law), std::move(particles)};
}

WallGrip grip_of(scene::Grip grip)
{
  return grip == scene::Grip::stick ? WallGrip::stick : WallGrip::slip;
}

void add_apparatus(const scene::Scene& scene, const SpecimenModel& specimen, const Layout& layout,
                   Model& model)
{
  const auto& loading = std::get<scene::Loading>(scene.motion);
  const ReactionBook book = book_of(scene.numerics);
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
        book_of(scene.numerics)));
  }
}

}  // namespace

Model make_model(const scene::Scene& scene, const SpecimenModel& specimen, const Layout& layout,
                 const Decomposition<2>& decomposition)
{
  Model model;
  model.transfer = make_transfer(scene.numerics, specimen.particles_per_cell);
  const Lattice& lattice = specimen.lattice;
  const int per_cell = specimen.particles_per_cell;
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (std::ranges::find(lattice.material, std::int8_t(k)) == lattice.material.end()) continue;
    if (material.law == scene::Law::rigid) {
      std::vector<Vec<2>> points;
      for (int j = 0; j < lattice.ny; ++j)
        for (int i = 0; i < lattice.nx; ++i)
          if (lattice(i, j) == std::int8_t(k))
            points.push_back({(i + 0.5) * layout.location_size[0],
                              (j + 0.5) * layout.location_size[1]});
      model.conditions.push_back(std::make_unique<RigidBody<2>>(
          std::move(points), Vec<2>(0.5 * layout.location_size[0], 0.5 * layout.location_size[1]),
          Vec<2>(material.velocity[0], material.velocity[1]), book_of(scene.numerics)));
      continue;
    }
    Body<2>& body = model.bodies.emplace_back(empty_body(material, int(k), scene, *model.transfer));
    BodyFiller filler(body, layout, decomposition, per_cell);
    for (int j = 0; j < lattice.ny; ++j)
      for (int i = 0; i < lattice.nx; ++i)
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
    GlobalIndex id = specimen.locations();
    const IndexBox<2>& box = layout.load_cell->locations;
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i) filler.add(i, j, id++, {0, 0});
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
