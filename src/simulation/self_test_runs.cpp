/// Runs of small scenes: on all ranks as on one, from a checkpoint as in one go, and how fast.

#include <mpm/core/error.hpp>
#include <mpm/core/lanes.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/checkpoints.hpp>
#include <mpm/simulation/history_line.hpp>
#include <mpm/simulation/run.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <vector>

#include "self_test_checks.hpp"
#include <fmt/format.h>

namespace mpm {

namespace {

/// Of each column's largest value: rounding of sums in other orders (docs/cluster.md).
constexpr double tolerance = 1e-9;
/// The row "block gimp" of docs/performance.md, on one rank.
constexpr double documented_ns = 31.6;

/// Cells as long as there are ranks to share them: each needs two along some axis.
struct Size {
  int across, up;
};

/// An elastic block between slippery sides, of which every part moves from the start on.
std::string vibrating_block(const char* formulation, const Size& cells)
{
  constexpr double cell = 1e-6, wave_speed = 3e3, cfl = 0.4, steps = 500;
  const double length = cells.across * cell, height = cells.up * cell;
  return fmt::format(
      "material: {{law: isotropic, youngs_modulus: 10.6 GPa, poisson_ratio: 0.33, "
      "density: 1500 kg/m^3}}\n"
      "specimen:\n"
      "  size: [{0:.6e} m, {1:.6e} m]\n"
      "  shapes: [box: {{lower: [0 m, 0 m], upper: [{0:.6e} m, {1:.6e} m]}}]\n"
      "  initial_velocity: [\"3*sin(pi*x/{1:.6e})*cos(pi*y/{1:.6e})\", \"2*sin(pi*y/{1:.6e})\"]\n"
      "grid: {{cells: [{2}, {3}]}}\n"
      "numerics: {{formulation: {4}}}\n"
      "free_motion: {{end_time: {5:.6e} s, sides: symmetric}}\n"
      "output: {{history_lines: 20, snapshots: 0, checkpoints: {{steps: 100, keep: 1}}}}\n",
      length, height, cells.across, cells.up, formulation, steps * cfl * cell / wave_speed);
}

/// What inputs/benchmarks/block_gimp.yaml measures, with so many cells.
std::string pressed_block(const Size& cells)
{
  constexpr double cell = 5e-6;
  return fmt::format(
      "material: {{law: von_mises, youngs_modulus: 10.6 GPa, poisson_ratio: 0.33, "
      "density: 1500 kg/m^3, yield_stress: 500 MPa}}\n"
      "specimen:\n"
      "  size: [{0:.6e} m, {1:.6e} m]\n"
      "  shapes: [box: {{lower: [0 m, 0 m], upper: [{0:.6e} m, {1:.6e} m]}}]\n"
      "grid: {{cells: [{2}, {3}]}}\n"
      "numerics: {{shape_function: gimp}}\n"
      "loading: {{piston: right, speed: 10 m/s, strain: 60 %}}\n"
      "steps: 200\n"
      "output: {{history_lines: 50, snapshots: 0}}\n",
      cells.across * cell, cells.up * cell, cells.across, cells.up);
}

/// Every rank reads what rank 0 has written to a new file. Collective.
scene::Scene scene_of(MPI_Comm comm, const std::filesystem::path& file, const std::string& text)
{
  scene::Scene scene;
  on_rank_zero(comm, [&] {
    std::ofstream out(file);
    out << text;
  });
  agree(comm, [&] { scene = scene::read_scene(file); });
  return scene;
}

RunResult run_it(MPI_Comm comm, const scene::Scene& scene, Continuation continuation = {})
{
  const Preparation<2> preparation(comm, scene, std::nullopt);
  return run<2>(preparation, {}, std::move(continuation));
}

Size size_for(int ranks)
{
  return {std::max(96, 3 * ranks), ranks <= 64 ? 40 : 16};
}

/// The largest difference over the largest value of its kind: energies among themselves.
double difference(const RunResult& a, const RunResult& b)
{
  if (a.lines.size() != b.lines.size() || a.steps != b.steps) return HUGE_VAL;
  const std::vector<output::HistoryColumn> columns = history_columns({});
  std::vector<double> largest(columns.size()), differences(columns.size());
  for (std::size_t line = 0; line < a.lines.size(); ++line) {
    const std::vector<double> one = history_row(a.lines[line], {}),
                              other = history_row(b.lines[line], {});
    for (std::size_t k = 0; k < columns.size(); ++k) {
      largest[k] = std::max(largest[k], std::abs(one[k]));
      differences[k] = std::max(differences[k], std::abs(one[k] - other[k]));
    }
  }
  double energy = 0, worst = 0;
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].unit == "J") energy = std::max(energy, largest[k]);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].name.ends_with("_error")) continue;  // differences of what is compared
    const double scale = columns[k].unit == "J" ? energy : largest[k];
    if (!(differences[k] <= tolerance * scale) && scale == 0) return HUGE_VAL;
    if (scale > 0) worst = std::max(worst, differences[k] / scale);
  }
  return worst;
}

bool same_bits(const RunResult& a, const RunResult& b)
{
  if (a.lines.size() != b.lines.size()) return false;
  for (std::size_t line = 0; line < a.lines.size(); ++line) {
    const std::vector<double> one = history_row(a.lines[line], {}),
                              other = history_row(b.lines[line], {});
    for (std::size_t k = 0; k < one.size(); ++k)
      if (std::bit_cast<std::uint64_t>(one[k]) != std::bit_cast<std::uint64_t>(other[k]))
        return false;
  }
  return true;
}

}  // namespace

std::string check_one_rank_agrees(MPI_Comm comm, const std::filesystem::path& folder,
                                  const char* formulation)
{
  const int ranks = ranks_of(comm);
  // Checkpoints of different runs would bear the same names.
  const std::filesystem::path own = folder / formulation;
  const scene::Scene scene = scene_of(comm, folder / (std::string(formulation) + ".yaml"),
                                      vibrating_block(formulation, size_for(ranks)));
  const RunResult together = run_it(comm, scene, {.results = own / "together"});
  double found = 0;
  on_rank_zero(comm, [&] {
    const RunResult alone = run_it(MPI_COMM_SELF, scene, {.results = own / "alone"});
    found = difference(together, alone);
    if (!(found <= tolerance))
      throw std::runtime_error(fmt::format(
          "{} ranks give another answer than one: histories differ by {:.2g} of their largest "
          "values, and {:.0e} is allowed. Build anew with one compiler, MPI and PETSc, and run the "
          "tests (docs/building.md).",
          ranks, found, tolerance));
  });
  return fmt::format("{} particles, {} steps: {}", together.particles, together.steps,
                     ranks == 1 ? "the same twice (with more ranks: on all of them as on one)"
                                : fmt::format("as on one rank to {:.0e} ({:.0e} allowed)",
                                              largest_over_ranks(comm, found), tolerance));
}

std::string check_checkpoint(MPI_Comm comm, const std::filesystem::path& folder)
{
  const scene::Scene scene =
      scene_of(comm, folder / "checkpoint.yaml",
               vibrating_block("updated_lagrangian", size_for(ranks_of(comm))));
  const std::filesystem::path results = folder / "checkpoint";
  const RunResult whole = run_it(comm, scene, {.results = results});
  LoadedState loaded = load_state(comm, CheckpointFolder(results), std::nullopt);
  std::string none;
  loaded.state->text(checkpoint_record, none);
  const RunResult again =
      run_it(comm, scene, {.results = results, .state = std::move(loaded.state)});
  on_rank_zero(comm, [&] {
    if (!same_bits(whole, again))
      throw std::runtime_error(
          "a run that goes on from its checkpoint does not end with the same bits. Build anew, and "
          "run the tests (docs/building.md).");
  });
  return fmt::format("a run goes on from step {} with the same bits",
                     std::stol(loaded.file.stem().string()));
}

std::string check_speed(MPI_Comm comm, const std::filesystem::path& folder)
{
  // 40,000 particles a rank, and no more than 4 million of all.
  const int ranks = ranks_of(comm), up = 100;
  const int per_rank = std::clamp(10'000 / ranks, 3, 100);
  const RunResult result =
      run_it(comm, scene_of(comm, folder / "speed.yaml", pressed_block({per_rank * ranks, up})));
  const double ns = result.ns_per_particle_step();
  std::string text = fmt::format(
      "{:.1f} ns per particle and step of each rank, in lanes of {}; {} in docs/performance.md "
      "(AMD EPYC, one rank, lanes of 8)",
      ns, lane_count, documented_ns);
  if (ns > 4 * documented_ns)
    text += ". Much slower: do ranks share cores, or is the build not a Release one?";
  return text;
}

}  // namespace mpm
