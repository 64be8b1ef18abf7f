#include <mpm/analysis/compression_summary.hpp>
#include <mpm/core/error.hpp>
#include <mpm/micrograph/preview.hpp>
#include <mpm/output/summary.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/load_balance.hpp>
#include <mpm/simulation/progress.hpp>
#include <mpm/simulation/provenance.hpp>
#include <mpm/simulation/recorder.hpp>
#include <mpm/simulation/run.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

namespace mpm {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<BoundaryCondition<2>*> pointers(
    const std::vector<std::unique_ptr<BoundaryCondition<2>>>& conditions)
{
  std::vector<BoundaryCondition<2>*> list;
  for (const auto& condition : conditions) list.push_back(condition.get());
  return list;
}

/// Moments of snapshots, ascending, s.
std::vector<double> snapshot_moments(const scene::Scene& scene,
                                     const micrograph::SpecimenModel& specimen,
                                     const Layout& layout)
{
  std::vector<double> times = scene.output.snapshot_times;
  for (const double strain : scene.output.snapshot_strains)
    times.push_back(time_of_strain(scene, specimen, layout.piston, strain));
  std::ranges::sort(times);
  return times;
}

class Run {
 public:
  Run(const scene::Scene& scene, const micrograph::SpecimenModel& specimen, const Layout& layout,
      const Decomposition<2>& decomposition, const std::filesystem::path& folder)
      : comm_(decomposition.comm()),
        scene_(scene),
        specimen_(specimen),
        layout_(layout),
        folder_(folder),
        start_(std::chrono::steady_clock::now()),
        model_(make_model(scene, specimen, layout, decomposition)),
        conditions_(pointers(model_.conditions)),
        stepper_(decomposition, std::move(model_.transfer), std::move(model_.bodies),
                 std::move(model_.conditions),
                 {scene.numerics.update_order->kind, 1e-24 * layout.largest_particle_mass}),
        balance_(partition_rules(scene), scene.numerics.repartition_interval),
        history_(folder, stepper_, conditions_, model_.apparatus),
        snapshots_(scene, folder, comm_),
        moments_(snapshot_moments(scene, specimen, layout)),
        end_(layout.end_time)
  {
    particles_ = stepper_.particles();
    sum_over_ranks(comm_, std::span(&particles_, 1));
  }

  void run()
  {
    const auto loop_start = std::chrono::steady_clock::now();
    const double line_interval = end_ / scene_.output.history_lines;
    std::size_t next_line = 1;
    write_due_snapshots();
    history_.record(stepper_, first_time_step(layout_));
    double speed = layout_.largest_speed;
    double dt = 0;
    while (!finished()) {
      if (stepper_.steps() % Stepper<2>::steps_between_checks == 0) {
        speed = std::max(layout_.largest_speed, stepper_.agreed().largest_speed);
        const double wave = std::max(layout_.wave_speed, stepper_.agreed().wave_speed);
        dt = layout_.cfl * layout_.geometry.smallest_spacing() / (wave + speed);
      }
      const double last = std::min(dt, end_ - stepper_.time());
      const bool line_due =
          stepper_.time() + last >= double(next_line) * line_interval * (1 - 1e-12) ||
          finished_at(stepper_.time() + last, stepper_.steps() + 1);
      if (line_due) history_.before_line(stepper_);
      stepper_.step(last);
      balance_.look(stepper_);
      history_.observe(stepper_);
      if (line_due) {
        stepper_.check();
        const HistoryLine& line = history_.record(stepper_, last);
        next_line = std::size_t(stepper_.time() / line_interval * (1 + 1e-12)) + 1;
        show(line);
      }
      write_due_snapshots();
    }
    loop_seconds_ = seconds_since(loop_start);
    progress_.finish();
    finish();
  }

 private:
  bool finished() const { return finished_at(stepper_.time(), stepper_.steps()); }

  bool finished_at(double time, GlobalIndex steps) const
  {
    return time >= end_ * (1 - 1e-12) || (scene_.steps && steps >= *scene_.steps);
  }

  void write_due_snapshots()
  {
    bool due = false;
    while (next_moment_ < moments_.size() &&
           stepper_.time() >= moments_[next_moment_] * (1 - 1e-9)) {
      due = true;
      ++next_moment_;
    }
    if (!due) return;
    stepper_.check();
    const auto start = std::chrono::steady_clock::now();
    snapshots_.write(stepper_, strain());
    output_seconds_ += seconds_since(start);
  }

  double strain() const
  {
    if (!model_.apparatus) return 0;
    return std::abs(model_.apparatus->piston->motion().displacement(stepper_.time())) /
           model_.apparatus->length;
  }

  void show(const HistoryLine& line)
  {
    if (rank_of(comm_) != 0) return;
    const double by_steps = scene_.steps ? double(stepper_.steps()) / double(*scene_.steps) : 0.0;
    progress_.show({std::max(stepper_.time() / end_, by_steps), long(stepper_.steps()), line.time,
                    line.strain, line.stress(), model_.apparatus.has_value(),
                    long(stepper_.steps() * particles_)});
  }

  void finish()
  {
    const GlobalIndex most_bytes = largest_memory();
    const Cooperation cooperation = measure_cooperation();
    agree(comm_, [&] {
      if (rank_of(comm_) == 0) write_summary(most_bytes, cooperation);
    });
  }

  /// How the ranks worked together.
  struct Cooperation {
    GlobalIndex migrated = 0;                          ///< particles, all ranks
    double messages_per_step = 0, bytes_per_step = 0;  ///< of the rank that sends most
    double waiting_seconds = 0;                        ///< of the one that waits most
    double imbalance = 1;                              ///< of particles, at the end
  };

  /// Collective.
  Cooperation measure_cooperation() const
  {
    const Stepper<2>::Counters mine = stepper_.counters();
    const double steps = double(std::max<GlobalIndex>(stepper_.steps(), 1));
    std::array<double, 4> largest{double(mine.messages) / steps, double(mine.bytes) / steps,
                                  mine.waiting_seconds, double(stepper_.particles())};
    largest_over_ranks(comm_, largest);
    GlobalIndex migrated = mine.migrated;
    sum_over_ranks(comm_, std::span(&migrated, 1));
    return {migrated, largest[0], largest[1], largest[2],
            largest[3] * ranks_of(comm_) / double(particles_)};
  }

  /// Particle and node arrays of the rank that has most, bytes.
  GlobalIndex largest_memory() const
  {
    double bytes = double(stepper_.grid().bytes());
    for (const Body<2>& body : stepper_.bodies()) bytes += double(body.particles.bytes());
    return GlobalIndex(largest_over_ranks(comm_, bytes));
  }

  analysis::CompressionProperties properties() const
  {
    std::vector<double> strain, stress;
    for (const HistoryLine& line : history_.lines()) {
      strain.push_back(line.strain);
      stress.push_back(line.stress());
    }
    // Before the first wave has come back the specimen is not loaded as a whole.
    const double length = model_.apparatus->length;
    analysis::CurveOptions options;
    options.discard_strain = layout_.piston.displacement(2 * length / layout_.wave_speed) / length;
    return analysis::compression_properties(strain, stress, options);
  }

  void write_summary(GlobalIndex most_bytes, const Cooperation& cooperation) const
  {
    const HistoryLine& last = history_.lines().back();
    output::Summary summary;
    summary.set("name", scene_.name);
    summary.set("title", scene_.title);
    summary.set("relative_density", specimen_.densities.front().value);
    summary.set("bulk_density", specimen_.densities.front().bulk_density);
    for (std::size_t k = 1; k < specimen_.densities.size(); ++k)
      summary.section("windows").set(specimen_.densities[k].window, specimen_.densities[k].value);
    summary.set("particles", particles_);
    summary.set("cells",
                std::vector<double>{double(specimen_.cells[0]), double(specimen_.cells[1])});
    summary.set("ranks", ranks_of(comm_));
    summary.set("steps", stepper_.steps());
    summary.set("time_step", first_time_step(layout_));
    summary.set("end_time", stepper_.time());
    if (model_.apparatus) summary.set("ramp_time", layout_.piston.ramp_time);
    summary.set("strain", strain());
    summary.set("wall_seconds", seconds_since(start_));
    summary.set("loop_seconds", loop_seconds_);
    summary.set("output_seconds", output_seconds_);
    summary.set("ns_per_particle_step", 1e9 * (loop_seconds_ - output_seconds_) * ranks_of(comm_) /
                                            (double(particles_) * double(stepper_.steps())));
    summary.set("largest_rank_bytes", most_bytes);
    const IndexVec<2> process_grid = stepper_.decomposition().ranks_per_axis();
    summary.set("decomposition", stepper_.decomposition().ownership().by_cuts()
                                     ? fmt::format("cuts {} x {}", process_grid[0], process_grid[1])
                                     : std::string("metis"));
    summary.set("migrated", cooperation.migrated);
    summary.set("repartitions", balance_.repartitions());
    summary.set("messages_per_step", cooperation.messages_per_step);
    summary.set("bytes_per_step", cooperation.bytes_per_step);
    summary.set("imbalance", cooperation.imbalance);
    summary.set("mean_imbalance", balance_.mean_imbalance());
    summary.set("mean_work_imbalance", balance_.mean_work_imbalance());
    summary.set("waiting_seconds", cooperation.waiting_seconds);
    summary.set("energy_error", last.energy_error);
    double largest_error = 0;
    for (const HistoryLine& line : history_.lines())
      if (line.strain > 0.01 || !model_.apparatus)
        largest_error = std::max(largest_error, std::abs(line.energy_error));
    summary.set("largest_energy_error", largest_error);
    if (model_.apparatus) {
      const auto found = properties();
      const auto strain_of = [](const auto& p) {
        return p ? std::optional<double>(p->strain) : std::nullopt;
      };
      const auto stress_of = [](const auto& p) {
        return p ? std::optional<double>(p->stress) : std::nullopt;
      };
      summary.set("modulus", found.modulus);
      summary.set("buckling_stress", stress_of(found.buckling));
      summary.set("buckling_strain", strain_of(found.buckling));
      summary.set("densification_stress", stress_of(found.densification));
      summary.set("densification_strain", strain_of(found.densification));
      summary.set("deepest_behind_piston", history_.deepest_behind_piston());
      analysis::describe(found, summary.section("compression"));
      print_properties(found);
    }
    for (const auto& [what, version] : provenance())
      summary.section("provenance").set(what, version);
    summary.section("provenance").set("scene", scene_.file.string());
    summary.write(folder_ / "summary.json");
    fmt::print(
        "{} steps in {:.1f} s, {:.1f} ns per particle and step, energy error {:.2f} %\n"
        "results in {}\n",
        stepper_.steps(), loop_seconds_,
        1e9 * (loop_seconds_ - output_seconds_) * ranks_of(comm_) /
            (double(particles_) * double(stepper_.steps())),
        100 * last.energy_error, folder_.string());
  }

  static void print_properties(const analysis::CompressionProperties& found)
  {
    const auto point = [](const char* what, const std::optional<analysis::CurvePoint>& p) {
      if (p)
        fmt::print("{:<24} {:8.1f} MPa at {:.2f} %\n", what, 1e-6 * p->stress, 100 * p->strain);
      else
        fmt::print("{:<24}        - (not reached or not distinct)\n", what);
    };
    if (found.modulus) fmt::print("{:<24} {:8.0f} MPa\n", "modulus", 1e-6 * *found.modulus);
    point("onset of buckling", found.buckling);
    point("onset of densification", found.densification);
  }

  MPI_Comm comm_;
  const scene::Scene& scene_;
  const micrograph::SpecimenModel& specimen_;
  const Layout& layout_;
  std::filesystem::path folder_;
  std::chrono::steady_clock::time_point start_;
  Model model_;
  std::vector<BoundaryCondition<2>*> conditions_;
  Stepper<2> stepper_;
  LoadBalance<2> balance_;
  History history_;
  Snapshots snapshots_;
  Progress progress_;
  std::vector<double> moments_;
  std::size_t next_moment_ = 0;
  double end_;
  GlobalIndex particles_ = 0;
  double loop_seconds_ = 0, output_seconds_ = 0;
};

}  // namespace

void run_scene(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
               const Layout& layout, const Decomposition<2>& decomposition,
               const std::filesystem::path& folder)
{
  const MPI_Comm comm = decomposition.comm();
  agree(comm, [&] {
    if (rank_of(comm) != 0) return;
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
      throw FileError(fmt::format("{}: cannot make this folder ({}). Choose another with --output.",
                                  folder.string(), failure.message()));
    std::ofstream effective(folder / "scene.yaml");
    scene::write_effective_scene(effective, scene);
    if (!effective.flush())
      throw FileError(fmt::format("{}: cannot write", (folder / "scene.yaml").string()));
    micrograph::write_preview(specimen, folder / "specimen.png");
  });
  Run(scene, specimen, layout, decomposition, folder).run();
}

}  // namespace mpm
