#include <mpm/parallel/session.hpp>
#include <mpm/simulation/kept_state.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/simulation/preparation.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Of the cost in the plane, by the shipped block scenes: a stencil has support times the nodes.
template <int Dim>
double step_cost(const scene::Numerics& numerics)
{
  return numerics.shape_function->step_cost * (Dim == 2 ? 1.0 : 2.5);
}

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

template <class Values>
std::string product(const Values& values, int count, const char* format = "{}")
{
  std::string text;
  for (int d = 0; d < count; ++d)
    text += (d ? " x " : "") + fmt::format(fmt::runtime(format), values[d]);
  return text;
}

/// Shape of the partition and its balance at the start.
template <int Dim>
std::string ranks_text(const Partition<Dim>& partition)
{
  const Ownership<Dim>& ownership = partition.ownership;
  if (ownership.ranks() == 1) return "1";
  const IndexVec<Dim> edges = IndexVec<Dim>::Constant(ownership.block_edge());
  return fmt::format("{}; busiest {:.3f} of the mean",
                     ownership.by_cuts() ? product(ownership.ranks_per_axis(), Dim)
                                         : fmt::format("{}, blocks of {} cells mapped by METIS",
                                                       ownership.ranks(), product(edges, Dim)),
                     partition.imbalance());
}

std::vector<std::string> left_out(const scene::Scene& scene, bool remaps)
{
  std::vector<std::string> list;
  const auto* loading = std::get_if<scene::Loading>(&scene.motion);
  const auto deformable = [](const scene::Material& m) { return m.law->deformable(); };
  if (std::ranges::none_of(scene.materials,
                           [](const scene::Material& m) { return m.law->has("yield_stress"); }))
    list.push_back("plasticity");
  if (loading && !loading->load_cell) list.push_back("load cell");
  if (scene.loads.empty()) list.push_back("loads");
  if (!remaps) list.push_back("re-mapping pass");
  if (!scene.numerics.scheme->affine) list.push_back("affine velocity field");
  if (std::ranges::all_of(scene.materials, deformable)) list.push_back("rigid bodies");
  if (scene.output.snapshot_strains.empty() && scene.output.snapshot_times.empty())
    list.push_back("snapshots");
  return list;
}

template <int Dim>
double bytes_per_particle(const scene::Scene& scene, const Transfer<Dim>& transfer)
{
  int largest = 0;
  const Loads<Dim> loads = loads_of<Dim>(scene);
  for (const scene::Material& material : scene.materials)
    if (material.law->deformable())
      largest = std::max(
          largest,
          empty_store(scene, transfer, *law_of<Dim>(material, scene), loads).packed_size());
  return sizeof(double) * double(largest);  // the id with the columns
}

}  // namespace

template <int Dim>
std::string plan_text(const Preparation<Dim>& preparation)
{
  const scene::Scene& scene = preparation.scene;
  const micrograph::Specimen<Dim>& specimen = preparation.specimen;
  const Layout<Dim>& layout = preparation.layout;
  const int ranks = ranks_of(preparation.comm);
  double particles = layout.load_cell ? double(layout.load_cell->locations.size()) : 0;
  for (std::size_t k = 0; k < scene.materials.size(); ++k)
    if (scene.materials[k].law->deformable())
      particles += double(specimen.particles_of_material()[k]);
  const double dt = time_step_of(layout).first(), steps = expected_steps(scene, layout);
  const auto transfer = make_transfer<Dim>(scene.numerics, layout.per_cell);
  const UpdateOrderRow& order = *scene.numerics.update_order;
  const double per_particle = bytes_per_particle(scene, *transfer);
  const double per_node = NodeFields<Dim>::bytes_per_node(
      {order.remaps || extras_of(scene.numerics).remap(), !scene.loads.empty()});
  const double nodes = layout.geometry.nodes.template cast<double>().prod();

  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18} {}\n", what, value);
  };
  const auto& densities = specimen.densities();
  text += fmt::format("{}\n", scene.title.empty() ? scene.name : scene.title);
  line("specimen", fmt::format("{} mm, relative density {:.4f}",
                               product(Vec<Dim>(1e3 * specimen.size()), Dim, "{:.4g}"),
                               densities.front().value));
  for (std::size_t k = 1; k < densities.size(); ++k)
    line("", fmt::format("{}: {:.4f}, {:.0f} kg/m3", densities[k].window, densities[k].value,
                         densities[k].bulk_density));
  if (specimen.picture())
    line("picture", fmt::format("relative density {:.4f}", specimen.picture()->density));
  line("bulk density", fmt::format("{:.1f} kg/m3", densities.front().bulk_density));
  line("grid",
       fmt::format("{} cells of {} um, {} locations per cell", product(specimen.cells(), Dim),
                   product(Vec<Dim>(1e6 * layout.geometry.spacing), Dim, "{:.4g}"),
                   product(IndexVec<Dim>(IndexVec<Dim>::Constant(layout.per_cell)), Dim)));
  line("particles", fmt::format("{:.0f} of {} locations", particles, specimen.locations()));
  const char* space = Dim == 3                                       ? "in space"
                      : scene.numerics.plane == scene::Plane::strain ? "plane strain"
                                                                     : "plane stress";
  line("method",
       fmt::format("{}, {}, {}, {}", scene.numerics.shape_function->words,
                   scene.numerics.scheme->words, scene.numerics.update_order->words, space));
  for (const scene::Material& material : scene.materials)
    if (material.law->deformable())
      line("material", fmt::format("{}: wave speed {:.0f} m/s, {:.0f} kg/m3", material.name,
                                   law_of<Dim>(material, scene)->wave_speed(), material.density()));
  for (const scene::Load& load : scene.loads)
    line("load", load.kind->keyword + ": " + load.kind->help);
  std::string absent;
  for (const std::string& what : left_out(scene, order.remaps))
    absent += (absent.empty() ? "" : ", ") + what;
  line("left out", absent.empty() ? "nothing" : absent);
  line("time step", fmt::format("{:.4g} s (CFL {:.3g})", dt, layout.cfl));
  // Compression makes waves faster and steps shorter on the way.
  line("steps", scene.steps ? fmt::format("{:.0f}, to t = {:.4g} s at most", steps, steps * dt)
                            : fmt::format("at least {:.0f}, to t = {:.4g} s", steps, steps * dt));
  line("ranks", ranks_text(preparation.partition));
  line("memory", fmt::format("{:.0f} B per particle, {:.0f} B per node, {} in all", per_particle,
                             per_node, memory(per_particle * particles + per_node * nodes)));
  line("last sound state", fmt::format("{} more at most, kept every {} steps for {}",
                                       memory(per_particle * particles + per_node * nodes),
                                       KeptState<Dim>::steps_between,
                                       scene.numerics.recovery == scene::Recovery::retry
                                           ? "another attempt and a snapshot of failure"
                                           : "a snapshot of failure"));
  line("run time",
       fmt::format("about {} on {} rank{} (order of magnitude)",
                   duration(1e-9 * step_cost<Dim>(scene.numerics) * particles * steps / ranks),
                   ranks, ranks == 1 ? "" : "s"));
  for (const std::string& warning : preparation.warnings) line("warning", warning);
  return text;
}

template std::string plan_text(const Preparation<2>&);
template std::string plan_text(const Preparation<3>&);

}  // namespace mpm
