#include <mpm/core/error.hpp>
#include <mpm/simulation/model.hpp>

#include <algorithm>
#include <cmath>

#include "placement.hpp"

namespace mpm {

using micrograph::Lattice;
using micrograph::SpecimenModel;

namespace {

/// Cells around everything, so that stencils of particles at the outermost place lie on the grid.
constexpr LocalIndex ghost_cells = 2;
/// Share of the specimen's width left empty beside a free lateral edge.
constexpr double free_margin = 0.25;
/// Length of the default smooth start in crossings of the specimen by the fastest wave. Waves in
/// wood run at half of that speed or less: two to four of its crossings, so that piston and edge
/// feel about the same force while the cell walls are still elastic.
constexpr double crossings_of_start = 8;

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

double fastest(const std::array<double, 2>& v)
{
  return std::max(std::abs(v[0]), std::abs(v[1]));
}

}  // namespace

std::array<double, 2> initial_velocity(const scene::Scene& scene, const Lattice& lattice,
                                       std::size_t location)
{
  if (lattice.shape.empty() || lattice.shape[location] < 0) return {0, 0};
  return scene.specimen.shapes[lattice.shape[location]].velocity;
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
      if (!scene.materials[material].law->deformable()) continue;
      layout.largest_speed =
          std::max(layout.largest_speed,
                   fastest(initial_velocity(scene, specimen.lattice, std::size_t(j) * nx + i)));
    }
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const scene::Material& material = scene.materials[k];
    if (!material.law->deformable()) {
      if (used[k])
        layout.largest_speed = std::max(layout.largest_speed, fastest(velocity_of(material)));
      continue;
    }
    if (!used[k]) continue;
    layout.largest_particle_mass =
        std::max(layout.largest_particle_mass, material.density() * layout.particle_volume);
    layout.wave_speed = std::max(layout.wave_speed, law_of(material, scene)->wave_speed());
  }
  if (layout.load_cell) {
    const scene::Material cell = load_cell_material(scene, layout.load_cell->density_ratio);
    layout.largest_particle_mass =
        std::max(layout.largest_particle_mass, cell.density() * layout.particle_volume);
    layout.wave_speed = std::max(layout.wave_speed, law_of(cell, scene)->wave_speed());
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

}  // namespace mpm
