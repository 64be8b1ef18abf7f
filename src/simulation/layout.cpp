#include <mpm/scene/sides.hpp>
#include <mpm/simulation/layout.hpp>
#include <mpm/simulation/method.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {

namespace {

/// Cells around everything, so that stencils of particles at the outermost place lie on the grid.
constexpr LocalIndex ghost_cells = 2;
/// Share of the specimen's width left empty beside a free lateral edge.
constexpr double free_margin = 0.25;
/// Length of the default smooth start in crossings of the specimen by the fastest wave. Waves in
/// wood run at half of that speed or less: two to four of its crossings, so that piston and edge
/// feel about the same force while the cell walls are still elastic.
constexpr double crossings_of_start = 8;

const scene::Loading* loading_of(const scene::Scene& scene)
{
  return std::get_if<scene::Loading>(&scene.motion);
}

/// m, beside the specimen, with room for free edges where none is given.
double margin_of(const scene::Scene& scene, int axis, bool upper, double size)
{
  const double margin = scene.grid.margin[std::size_t(2 * axis + upper)];
  const auto side = scene::side_of(scene, axis, upper);
  const bool open = loading_of(scene) && side && (*side)->open();
  return open && margin == 0 ? free_margin * size : margin;
}

/// Whether a wall at rest holds nodes at a side of the specimen, or behind its load cell.
bool has_wall(const scene::Scene& scene, int axis, bool upper)
{
  if (const auto* free = std::get_if<scene::FreeMotion>(&scene.motion))
    for (const scene::MovingSide& moving : free->moving_sides)
      if (axis_of(moving.side) == axis && upper_of(moving.side) == upper) return false;
  if (const auto side = scene::side_of(scene, axis, upper)) return (*side)->is_wall();
  const scene::Loading& loading = *loading_of(scene);  // the edge is fixed, and holds or pushes
  return upper_of(loading.piston) != upper && loading.grip != scene::Grip::contact;
}

/// `first` and `last`: nodes of the specimen's sides.
template <int Dim>
void stand_walls(const scene::Scene& scene, int axis, LocalIndex first, LocalIndex last,
                 Layout<Dim>& layout)
{
  auto& [below, above] = layout.geometry.walls[std::size_t(axis)];
  if (has_wall(scene, axis, false)) below = first;
  if (has_wall(scene, axis, true)) above = last;
  const auto* loading = loading_of(scene);
  if (!loading || !loading->load_cell || axis_of(loading->piston) != axis) return;
  if (below) *below -= loading->load_cell->cells;
  if (above) *above += loading->load_cell->cells;
}

template <int Dim>
void lay_grid(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
              Layout<Dim>& layout)
{
  IndexVec<Dim> before, after;
  for (int d = 0; d < Dim; ++d) {
    const double size = specimen.size()[d], h = size / specimen.cells()[d];
    layout.geometry.spacing[d] = h;
    layout.location_size[d] = h / layout.per_cell;
    layout.geometry.periodic[d] = scene::is_periodic(scene, d);
    const auto cells = [&](bool upper) -> LocalIndex {
      if (layout.geometry.periodic[d]) return 0;
      return ghost_cells + LocalIndex(std::ceil(margin_of(scene, d, upper, size) / h - 1e-9));
    };
    before[d] = cells(false);
    after[d] = cells(true);
  }
  if (const auto* loading = loading_of(scene); loading && loading->load_cell) {
    const int axis = axis_of(loading->piston);
    const bool below = upper_of(loading->piston);
    const LocalIndex cells = loading->load_cell->cells, layers = cells * layout.per_cell;
    (below ? before : after)[axis] += cells;
    IndexBox<Dim> box = specimen.whole();
    box.lower[axis] = below ? -layers : specimen.count()[axis];
    box.upper[axis] = box.lower[axis] + layers;
    layout.load_cell = {box, loading->load_cell->stiffness_ratio};
  }
  layout.padding = before;
  for (int d = 0; d < Dim; ++d) {
    layout.geometry.origin[d] = -before[d] * layout.geometry.spacing[d];
    layout.geometry.nodes[d] =
        before[d] + specimen.cells()[d] + after[d] + (layout.geometry.periodic[d] ? 0 : 1);
    stand_walls(scene, d, before[d], before[d] + specimen.cells()[d], layout);
  }
}

template <int Dim>
void measure_materials(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                       Layout<Dim>& layout)
{
  layout.largest_particle_mass = 0;
  layout.wave_speed = 0;
  const auto deformable = [&](const scene::Material& material) {
    layout.largest_particle_mass =
        std::max(layout.largest_particle_mass, material.density() * layout.particle_volume);
    layout.wave_speed = std::max(layout.wave_speed, law_of<Dim>(material, scene)->wave_speed());
  };
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (specimen.particles_of_material()[k] == 0) continue;
    if (material.law->deformable()) {
      deformable(material);
      continue;
    }
    for (const WallMotion& motion : motion_of<Dim>(material))
      layout.largest_speed = std::max(layout.largest_speed, motion.largest_speed());
  }
  if (layout.load_cell) deformable(load_cell_material(scene, layout.load_cell->density_ratio));
}

/// Of the stable step, beside walls that push. A particle alone bears 2 / sqrt(kappa) of the time
/// in which the fastest wave crosses it; with this rule seven tenths of a step do. Bars that end
/// anywhere between the nodes, whose particles share theirs, bear more (linear stability).
double share_beside_walls(const scene::Scene& scene)
{
  if (!scene::walls_push(scene)) return 1;
  const double stiffness =
      contact_stiffness(scene.numerics) * std::pow(scene.grid.particles_per_cell, 2) / 8;
  const double alone = stable_cfl_of(scene.numerics).value_or(1);
  return 1 / std::sqrt(1 + alone * alone * stiffness);
}

}  // namespace

template <int Dim>
std::array<WallMotion, Dim> motion_of(const scene::Material& rigid)
{
  std::array<WallMotion, Dim> motion;
  for (int d = 0; d < Dim; ++d) {
    motion[d].speed = rigid.values.vector("velocity")[std::size_t(d)];
    for (const TimeTable::Row& row : rigid.values.table("velocity_table").rows)
      motion[d].table.push_back({row.time, row.values[std::size_t(d)]});
  }
  return motion;
}

scene::Material load_cell_material(const scene::Scene& scene, double ratio)
{
  const auto first = std::ranges::find_if(
      scene.materials, [](const scene::Material& m) { return m.law->deformable(); });
  scene::Material cell{
      .name = "load_cell",
      .law = "isotropic",
      .values = {{"density", ratio * first->density()},
                 {"youngs_modulus", ratio * first->values.number("youngs_modulus")},
                 {"poisson_ratio", first->values.number("poisson_ratio")}}};
  fill_defaults(*cell.law, cell.values);
  return cell;
}

double time_of_strain(const WallMotion& piston, double length, double strain)
{
  return strain > 0 ? piston.time_of(strain * length) : 0.0;
}

template <int Dim>
Layout<Dim> make_layout(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen)
{
  Layout<Dim> layout;
  layout.per_cell = specimen.particles_per_cell();
  lay_grid(scene, specimen, layout);
  layout.particle_volume =
      layout.location_size.prod() * (Dim == 2 ? scene.numerics.thickness : 1.0);
  const auto* loading = loading_of(scene);
  layout.largest_speed = std::max(loading ? loading->speed : 0, specimen.largest_initial_speed());
  measure_materials(scene, specimen, layout);
  layout.cfl = default_cfl(scene.numerics);
  layout.crossed_in_step = is_total_lagrangian(scene.numerics)
                               ? layout.location_size.minCoeff()
                               : layout.geometry.smallest_spacing() * share_beside_walls(scene);
  if (loading) {
    const double length = specimen.size()[axis_of(loading->piston)];
    const double crossing = length / layout.wave_speed;
    layout.piston = {loading->speed, loading->ramp_time.value_or(crossings_of_start * crossing)};
    layout.end_time = time_of_strain(layout.piston, length, loading->strain);
  } else {
    const auto& free = std::get<scene::FreeMotion>(scene.motion);
    layout.end_time = free.end_time;
    for (const scene::MovingSide& side : free.moving_sides)
      layout.largest_speed =
          std::max(layout.largest_speed, WallMotion{.table = side.table}.largest_speed());
  }
  return layout;
}

template std::array<WallMotion, 2> motion_of<2>(const scene::Material&);
template std::array<WallMotion, 3> motion_of<3>(const scene::Material&);
template Layout<2> make_layout(const scene::Scene&, const micrograph::Specimen<2>&);
template Layout<3> make_layout(const scene::Scene&, const micrograph::Specimen<3>&);

}  // namespace mpm
