#pragma once
/// What a run leaves behind while it goes: history lines with the checks that belong to them, and
/// snapshots.

#include <mpm/output/history.hpp>
#include <mpm/output/snapshot.hpp>
#include <mpm/simulation/measures.hpp>

#include <filesystem>
#include <memory>
#include <optional>

namespace mpm {

/// One line of history.csv.
struct HistoryLine {
  double time = 0;              ///< s
  double strain = 0;            ///< piston displacement / specimen length
  double piston_stress = 0;     ///< Pa, mean since the last line, compression positive
  double edge_stress = 0;       ///< Pa
  double load_cell_stress = 0;  ///< Pa, where there is a load cell
  ParticleSums sums;
  double external_work = 0;  ///< J, of all conditions
  /// What is too much in the energy balance, all of it at the moment of the velocities, / external
  /// work.
  double energy_error = 0;
  /// |momentum gained - impulse of all conditions| / (sum of the impulses' sizes + momentum at
  /// the start): rounding, unless something is lost.
  double momentum_error = 0;
  double time_step = 0;                              ///< s
  GlobalIndex behind_piston = 0, outside_walls = 0;  ///< particles

  /// The applied stress: mean of both ends, in which a wave on its way counts once.
  double stress() const { return 0.5 * (piston_stress + edge_stress); }
};

class History {
 public:
  /// Opens folder/history.csv on rank 0 and measures the start. `conditions` live as long as this.
  /// Collective.
  History(const std::filesystem::path& folder, const Formulation<2>& formulation,
          std::vector<BoundaryCondition<2>*> conditions, std::optional<Apparatus> apparatus);

  /// Before the step that a line is recorded after: the energy balance needs both sides of it.
  /// Collective.
  void before_line(const Formulation<2>& formulation);
  /// After every step: the load cell's reading goes into the mean.
  void observe(const Formulation<2>& formulation);
  /// Measures, checks and writes a line. Collective. Throws NumericalError on every rank if
  /// particles were lost or doubled or a number is no longer one; warns when a particle is more
  /// than one cell behind a face.
  const HistoryLine& record(const Formulation<2>& formulation, double dt);

  const std::vector<HistoryLine>& lines() const { return lines_; }
  double deepest_behind_piston() const { return deepest_behind_piston_; }  ///< m, whole run

 private:
  void check(const Formulation<2>& formulation, const HistoryLine& line) const;
  void count_outside(const Formulation<2>& formulation, HistoryLine& line);
  void warn_of(const Formulation<2>& formulation, const Penetration& found, const char* what) const;

  MPI_Comm comm_;
  std::vector<BoundaryCondition<2>*> conditions_;
  std::optional<Apparatus> apparatus_;
  std::unique_ptr<output::HistoryFile> file_;  ///< rank 0
  std::vector<HistoryLine> lines_;
  ParticleSums start_;
  std::optional<double> stress_work_before_;  ///< J, before the last step
  double external_work_ = 0;
  Vec<2> impulse_ = Vec<2>::Zero();  ///< N s, of all conditions
  double impulse_size_ = 0;          ///< N s, sum of the sizes
  double last_time_ = 0;
  AxialStress load_cell_;
  double deepest_behind_piston_ = 0;
};

/// Writes the particles of all bodies with the fields that the scene asks for.
class Snapshots {
 public:
  /// Collective.
  Snapshots(const scene::Scene& scene, const std::filesystem::path& folder, MPI_Comm comm);
  /// Collective.
  void write(const Formulation<2>& formulation, double strain);
  int written() const { return series_.written(); }

 private:
  std::vector<scene::Field> fields_;
  output::SnapshotSeries series_;
};

}  // namespace mpm
