#include <mpm/core/folded.hpp>
#include <mpm/core/memory.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/kept_state.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/snapshots.hpp>
#include <mpm/simulation/step_measurement.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mpm {

namespace {

/// ns, with contact, over the whole crush of shipped woods, and of a bundle of tubes.
template <int Dim>
constexpr double cost_of_cells = Dim == 2 ? 45 : 350;

/// ns a particle, where steps cannot be measured. Of the cost in the plane, by the shipped block
/// scenes: a stencil has support times the nodes.
template <int Dim>
double step_cost(const scene::Numerics& numerics)
{
  if (is_total_lagrangian(numerics)) return cost_of_cells<Dim>;
  return numerics.shape_function->step_cost * (Dim == 2 ? 1.0 : 2.5);
}

std::string duration(double seconds)
{
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
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

/// Lines of the plan, and so are those below.
template <int Dim>
std::vector<std::string> run_time_text(const Preparation<Dim>& preparation,
                                       const StepMeasurement& measured)
{
  const Plan& plan = preparation.plan;
  const int ranks = ranks_of(preparation.comm);
  const std::string on = fmt::format("on {} rank{}", ranks, ranks == 1 ? "" : "s");
  if (measured.steps == 0) {
    const double seconds =
        1e-9 * step_cost<Dim>(preparation.scene.numerics) * plan.particles() * plan.steps / ranks;
    return {fmt::format("about {} {} (order of magnitude)", duration(seconds), on),
            "not measured: " + measured.why_none};
  }
  std::vector<std::string> lines{fmt::format(
      "{} {}: {:.3g} ms a step ({} step{} measured)", duration(measured.seconds * plan.steps), on,
      1e3 * measured.seconds, measured.steps, measured.steps == 1 ? "" : "s")};
  if (plan.contact_cells > 0)
    lines.push_back("until walls have met everywhere, two to four times as long in all");
  return lines;
}

template <int Dim>
std::vector<std::string> files_text(const Preparation<Dim>& preparation,
                                    const StepMeasurement& measured)
{
  const scene::Output& output = preparation.scene.output;
  std::vector<std::string> lines{fmt::format("history of {} lines", output.history_lines)};
  if (measured.checkpoint_bytes == 0) return lines;
  const std::vector<double> moments = snapshot_moments(preparation);
  const auto count = std::ranges::count_if(
      moments, [&](double moment) { return moment <= preparation.plan.end_time * (1 + 1e-9); });
  if (count > 0)
    lines.push_back(fmt::format("{} snapshot{}, {} each{}, {} in all", count, count == 1 ? "" : "s",
                                memory_text(measured.snapshot_bytes),
                                output.compress ? " before compression" : "",
                                memory_text(double(count) * measured.snapshot_bytes)));
  if (output.checkpoints)
    lines.push_back(fmt::format("checkpoints, {} each, the last {} kept",
                                memory_text(measured.checkpoint_bytes), output.checkpoints->keep));
  else
    lines.push_back(fmt::format("a checkpoint where a signal ends the run, {}",
                                memory_text(measured.checkpoint_bytes)));
  return lines;
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

/// The passes over the particles, equal ones in a row as "3 x name".
std::string passes_text(const std::vector<PassOutline>& passes)
{
  std::string text = fmt::format("{} pass{}:", passes.size(), passes.size() == 1 ? "" : "es");
  for (std::size_t k = 0, end; k < passes.size(); k = end) {
    for (end = k + 1; end < passes.size() && passes[end] == passes[k];) ++end;
    text += fmt::format("{} {}{}", k ? "," : "", end - k > 1 ? fmt::format("{} x ", end - k) : "",
                        passes[k].name);
  }
  return text;
}

}  // namespace

template <int Dim>
std::string plan_text(const Preparation<Dim>& preparation, const StepMeasurement* measured)
{
  const scene::Scene& scene = preparation.scene;
  const micrograph::Specimen<Dim>& specimen = preparation.specimen;
  const Layout<Dim>& layout = preparation.layout;
  const Plan& plan = preparation.plan;
  const int ranks = ranks_of(preparation.comm);
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18} {}\n", what, folded(value, 21));
  };
  const auto lines = [&](const char* what, const std::vector<std::string>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) line(k == 0 ? what : "", values[k]);
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
  line("grid", fmt::format("{} cells of {} um", product(specimen.cells(), Dim),
                           product(Vec<Dim>(1e6 * layout.geometry.spacing), Dim, "{:.4g}")));
  line("particles",
       fmt::format("{:.0f} of {} locations, {} per cell", plan.particles(), specimen.locations(),
                   product(IndexVec<Dim>(IndexVec<Dim>::Constant(layout.per_cell)), Dim)));
  line("method", fmt::format("{}", fmt::join(plan.method, ", ")));
  for (const Plan::Particles& body : plan.bodies)
    line("material", fmt::format("{}: wave speed {:.0f} m/s, {:.0f} kg/m3", body.body,
                                 body.wave_speed, body.density));
  for (const std::string& load : plan.loads) line("load", load);
  std::vector<std::string> absences;
  for (const Plan::LeftOut& absent : plan.left_out)
    absences.push_back(fmt::format("{}: {}", absent.what, absent.why));
  lines("left out", absences);
  line("time step", fmt::format("{:.4g} s (CFL {:.3g})", plan.time_step, layout.cfl));
  // Compression makes waves faster and steps shorter on the way.
  line("steps", fmt::format("{}{:.0f}, to t = {:.4g} s{}", scene.steps ? "" : "at least ",
                            plan.steps, plan.end_time, scene.steps ? " at most" : ""));
  line("a step", passes_text(plan.passes));
  if (ranks > 1)
    line("messages", fmt::format("{:.0f} a step, {:.3g} kB, from the busiest rank",
                                 plan.messages_per_step, 1e-3 * plan.bytes_per_step));
  line("ranks", ranks_text(preparation.partition));
  line("memory",
       fmt::format("{} B per particle, {} B per node, {} in all", plan.bytes_per_particle(),
                   plan.nodes.bytes(), memory_text(plan.bytes())));
  line("nodes",
       fmt::format("{:.0f} allocated; updated: ", plan.nodes.allocated) +
           (plan.nodes.reach ? fmt::format("{} below to {} above used cells",
                                           plan.nodes.reach->below, plan.nodes.reach->above)
                             : "all"));
  if (plan.contact_cells > 0) {
    line("contact",
         fmt::format("{:.0f} cells may meet others: those near a surface", plan.contact_cells));
    // Of crushed loblolly at 55 % strain and 50 m/s, in space at 35 % and 25 m/s.
    constexpr double bytes_of_lists = Dim == 2 ? 1.6e3 : 8e3;
    line("", fmt::format("whose lists take some {} more where walls lie close",
                         memory_text(plan.contact_cells * bytes_of_lists)));
  }
  if (plan.hinges > 0) {
    line("hinges", fmt::format("{:.0f} node{} at which walls hang together by a corner alone",
                               plan.hinges, plan.hinges == 1 ? "" : "s"));
    line("", "and turn freely: finer cells leave fewer of them");
  }
  line("last sound state", fmt::format("{} more at most, kept every {} steps for",
                                       memory_text(plan.bytes()), KeptState<Dim>::steps_between));
  line("", scene.numerics.recovery == scene::Recovery::retry
               ? "another attempt and a snapshot of failure"
               : "a snapshot of failure");
  if (ranks > 1 && is_total_lagrangian(scene.numerics))
    line("moving borders", fmt::format("{} more for a moment", memory_text(plan.bytes())));
  if (measured) {
    lines("run time", run_time_text(preparation, *measured));
    lines("files", files_text(preparation, *measured));
  }
  for (const std::string& warning : preparation.warnings) line("warning", warning);
  return text;
}

template std::string plan_text(const Preparation<2>&, const StepMeasurement*);
template std::string plan_text(const Preparation<3>&, const StepMeasurement*);

}  // namespace mpm
