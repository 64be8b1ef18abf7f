#include <mpm/simulation/run.hpp>

#include <algorithm>
#include <cmath>

#include "placement.hpp"
#include <fmt/format.h>

namespace mpm {

namespace {

std::string memory(double bytes)
{
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                     : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string duration(double seconds)
{
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// Shape of the partition and its balance at the start.
std::string ranks_text(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
                       const Layout& layout, const Ownership<2>& ownership)
{
  if (ownership.ranks() == 1) return "1";
  const std::vector<double> loads = loads_of<2>(ownership, [&](const auto& visit) {
    for_each_particle_cell(scene, specimen, layout, {}, visit);
  });
  const IndexVec<2> grid = ownership.ranks_per_axis();
  return fmt::format(
      "{}; busiest {:.3f} of the mean",
      ownership.by_cuts()
          ? fmt::format("{} x {}", grid[0], grid[1])
          : fmt::format("{}, blocks of {} x {} cells mapped by METIS", ownership.ranks(),
                        ownership.block_edge(), ownership.block_edge()),
      imbalance_of(loads));
}

std::vector<std::string> left_out(const scene::Scene& scene)
{
  std::vector<std::string> list;
  const auto* loading = std::get_if<scene::Loading>(&scene.motion);
  const auto deformable = [](const scene::Material& m) { return m.law->deformable(); };
  if (std::ranges::none_of(scene.materials,
                           [](const scene::Material& m) { return m.law->has("yield_stress"); }))
    list.push_back("plasticity");
  if (loading && !loading->load_cell) list.push_back("load cell");
  if (!scene.numerics.update_order->remaps) list.push_back("re-mapping pass");
  if (!scene.numerics.scheme->affine) list.push_back("affine velocity field");
  if (std::ranges::all_of(scene.materials, deformable)) list.push_back("rigid bodies");
  if (scene.output.snapshot_strains.empty() && scene.output.snapshot_times.empty())
    list.push_back("snapshots");
  return list;
}

}  // namespace

double first_time_step(const Layout& layout)
{
  return layout.cfl * layout.geometry.smallest_spacing() /
         (layout.wave_speed + layout.largest_speed);
}

std::string plan_text(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
                      const Layout& layout, const Decomposition<2>& decomposition)
{
  const int ranks = decomposition.ranks();
  double particles = 0;
  for_each_particle_cell(scene, specimen, layout, {}, [&](const IndexVec<2>&) { particles += 1; });
  const double dt = first_time_step(layout);
  double steps = std::ceil(layout.end_time / dt);
  if (scene.steps) steps = std::min(steps, double(*scene.steps));

  const auto transfer = make_transfer<2>(scene.numerics.shape_function, scene.numerics.scheme,
                                         specimen.particles_per_cell);
  int particle_columns = 1;  // id
  for (const Column& c : transfer->motion_columns(scene.numerics.update_order->remaps))
    particle_columns += c.components;
  int state_columns = 0;
  for (const scene::Material& material : scene.materials) {
    if (!material.law->deformable()) continue;
    int columns = 0;
    for (const Column& c : law_of(material, scene)->state_columns()) columns += c.components;
    state_columns = std::max(state_columns, columns);
  }
  const double bytes_per_particle = 8.0 * (particle_columns + state_columns);
  constexpr double bytes_per_node = 8.0 * (1 + 4 + 4 + 2 + 4);
  const double nodes = double(layout.geometry.nodes[0]) * layout.geometry.nodes[1];

  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18} {}\n", what, value);
  };
  text += fmt::format("{}\n", scene.title.empty() ? scene.name : scene.title);
  line("specimen",
       fmt::format("{:.4g} x {:.4g} mm, relative density {:.4f}", 1e3 * specimen.size[0],
                   1e3 * specimen.size[1], specimen.densities.front().value));
  for (std::size_t k = 1; k < specimen.densities.size(); ++k)
    line("", fmt::format("{}: {:.4f}, {:.0f} kg/m3", specimen.densities[k].window,
                         specimen.densities[k].value, specimen.densities[k].bulk_density));
  line("bulk density", fmt::format("{:.1f} kg/m3", specimen.densities.front().bulk_density));
  line("grid", fmt::format("{} x {} cells of {:.4g} x {:.4g} um, {} x {} locations per cell",
                           specimen.cells[0], specimen.cells[1], 1e6 * layout.geometry.spacing[0],
                           1e6 * layout.geometry.spacing[1], specimen.particles_per_cell,
                           specimen.particles_per_cell));
  line("particles", fmt::format("{:.0f} of {} locations", particles, specimen.locations()));
  line("method", fmt::format("{}, {}, {}, plane {}", scene.numerics.shape_function->words,
                             scene.numerics.scheme->words, scene.numerics.update_order->words,
                             scene.numerics.plane == scene::Plane::strain ? "strain" : "stress"));
  for (const scene::Material& material : scene.materials)
    if (material.law->deformable())
      line("material", fmt::format("{}: wave speed {:.0f} m/s, {:.0f} kg/m3", material.name,
                                   law_of(material, scene)->wave_speed(), material.density()));
  std::string absent;
  for (const std::string& what : left_out(scene)) absent += (absent.empty() ? "" : ", ") + what;
  line("left out", absent.empty() ? "nothing" : absent);
  line("time step", fmt::format("{:.4g} s (CFL {:.3g})", dt, layout.cfl));
  // Compression makes waves faster and steps shorter on the way.
  line("steps", scene.steps ? fmt::format("{:.0f}, to t = {:.4g} s at most", steps, steps * dt)
                            : fmt::format("at least {:.0f}, to t = {:.4g} s", steps, steps * dt));
  line("ranks", ranks_text(scene, specimen, layout, decomposition.ownership()));
  line("memory", fmt::format("{:.0f} B per particle, {:.0f} B per node, {} in all",
                             bytes_per_particle, bytes_per_node,
                             memory(bytes_per_particle * particles + bytes_per_node * nodes)));
  line("run time", fmt::format("about {} on {} rank{} (order of magnitude)",
                               duration(1e-9 * scene.numerics.shape_function->step_cost *
                                        particles * steps / ranks),
                               ranks, ranks == 1 ? "" : "s"));
  return text;
}

}  // namespace mpm
