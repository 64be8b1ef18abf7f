#include <mpm/simulation/method.hpp>
#include <mpm/simulation/result_warnings.hpp>
#include <mpm/simulation/warnings.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mpm {

namespace {

/// Of the external work: what stresses at large strains are then off by, or more.
constexpr double open_balance = 0.02;
/// Of the mean stress, between piston and fixed edge.
constexpr double dynamic_share = 0.05;
/// Waves have come and gone.
constexpr double loaded_strain = 0.02;
/// Over which ends are compared: what rings is over within.
constexpr double strain_window = 0.01;

using Warnings = std::vector<std::string>;

void look_at_failed_cells(const RunResult& result, Warnings& warnings)
{
  const HistoryLine& last = result.lines.back();
  if (last.failed_cells == 0) return;
  warnings.push_back(fmt::format(
      "{} of {} cells have failed and were removed, and {:.4g} J with them. Results depend on "
      "the limits of failure and, where it localises, on the size of the cells.",
      last.failed_cells, result.particles, last.failed_energy));
}

void look_at_balance(const scene::Scene& scene, const RunResult& result, Warnings& warnings)
{
  const auto judged = [](const HistoryLine& line) { return judged_energy_error(line, true); };
  const auto worst = std::ranges::max_element(result.lines, {}, judged);
  if (judged(*worst) <= open_balance) return;
  const bool jumps =
      !is_total_lagrangian(scene.numerics) && !scene.numerics.shape_function->stable_cfl.affine;
  warnings.push_back(fmt::format(
      "the energy balance is open by {:.2g} % of the work at {:.3g} % strain: {}, and stresses are "
      "uncertain by as much from there on. {}",
      100 * judged(*worst), 100 * worst->strain,
      worst->energy_error < 0 ? "work is lost" : "there is more than was put in",
      jumps ? "Gradients that jump at cell borders do that: take numerics.shape_function: gimp."
            : "Lower numerics.cfl, or refine grid.cells."));
}

/// Mean over windows of strain of what the ends differ by, over the stress there.
double difference_of_ends(const std::vector<HistoryLine>& lines)
{
  double shares = 0;
  int windows = 0;
  double piston = 0, edge = 0, end = loaded_strain + strain_window;
  for (const HistoryLine& line : lines) {
    if (line.strain < loaded_strain) continue;
    piston += line.piston_stress;
    edge += line.edge_stress;
    if (line.strain < end) continue;
    if (piston + edge > 0) {
      shares += 2 * std::abs(piston - edge) / (piston + edge);
      ++windows;
    }
    piston = edge = 0;
    end = line.strain + strain_window;
  }
  return windows > 0 ? shares / windows : 0;
}

/// Of a piston whose speed alone gave no reason to warn: slow waves of the structure, or heavy
/// cells.
void look_at_ends(const scene::Loading& loading, double wave_speed, const RunResult& result,
                  Warnings& warnings)
{
  if (loading.speed > quasi_static_speed * wave_speed) return;
  const double share = difference_of_ends(result.lines);
  if (share <= dynamic_share) return;
  const double heaviest = std::ranges::max(result.lines, {}, &HistoryLine::added_mass).added_mass;
  warnings.push_back(fmt::format(
      "stresses at the piston and at the fixed edge differ by {:.0f} % on the average: the run is "
      "not quasi-static. Lower loading.speed{}.",
      100 * share,
      heaviest > 1
          ? fmt::format(" or numerics.mass_scaling (cells became {:.2g} times heavier)", heaviest)
          : ""));
}

}  // namespace

std::vector<std::string> warnings_of_result(const scene::Scene& scene, double wave_speed,
                                            const RunResult& result)
{
  Warnings warnings;
  look_at_failed_cells(result, warnings);
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion)) {
    look_at_balance(scene, result, warnings);
    look_at_ends(*loading, wave_speed, result, warnings);
  }
  return warnings;
}

}  // namespace mpm
