#pragma once
/// Scalars over time, with the checks that belong to them.

#include <mpm/simulation/energy_monitor.hpp>
#include <mpm/simulation/history_line.hpp>
#include <mpm/simulation/measures.hpp>
#include <mpm/simulation/model.hpp>

#include <optional>
#include <vector>

namespace mpm {

template <int Dim>
class History {
 public:
  /// Measures the start. The apparatus' walls live as long as this. `largest_speed` of what is
  /// moved from outside, m/s. Collective.
  History(Formulation<Dim>& formulation, std::optional<Apparatus<Dim>> apparatus,
          double largest_speed);

  HistoryKind kind() const;
  /// Before the step that a line is recorded after: the energy balance needs both sides of it.
  /// Collective.
  void before_line();
  /// After every step: the load cell's reading goes into the mean, and from time to time the energy
  /// balance is looked at. Collective. Throws NumericalError on every rank, EnergyMonitor.
  void observe();
  /// Measures and checks. Collective. Throws NumericalError on every rank if particles were lost or
  /// doubled, a number is no longer one or the energy grows by itself; warns when a particle is
  /// more than one cell behind a face.
  const HistoryLine& record(double dt);

  const std::vector<HistoryLine>& lines() const { return lines_; }
  double deepest_behind_piston() const { return deepest_behind_piston_; }  ///< m, whole run
  /// Whether a run may go back to the present state: at the last look the surplus of energy was
  /// below half its bound.
  bool is_sound() const { return energy_.gain() < 0.5 * EnergyMonitor<Dim>::bound; }
  /// All lines, and what the next ones count from.
  void archive(Archive& archive);

 private:
  MPI_Comm comm() const { return formulation_.decomposition().comm(); }
  void take_reactions();
  void read_load_cell();
  void begin_line(HistoryLine& line);
  double surplus(const Sums<Dim>& sums) const;
  double work_ahead(const Sums<Dim>& sums) const;
  void balance(HistoryLine& line, const Sums<Dim>& sums);
  void check(const Sums<Dim>& sums, const HistoryLine& line) const;
  void count_outside(HistoryLine& line);
  void warn_of(const Penetration& found, const char* what) const;

  Formulation<Dim>& formulation_;
  std::optional<Apparatus<Dim>> apparatus_;
  std::vector<HistoryLine> lines_;
  Sums<Dim> start_;
  std::optional<double> work_ahead_before_;  ///< J, before the last step
  double external_work_ = 0;
  Vec<Dim> impulse_ = Vec<Dim>::Zero();  ///< N s, from outside
  double impulse_size_ = 0;              ///< N s, sum of the sizes
  double last_kicked_time_ = 0;
  AxialStress load_cell_;
  double work_size_ = 0;  ///< J, sum of the sizes
  /// Since the last line, N s along the axis.
  double piston_impulse_ = 0, edge_impulse_ = 0;
  double least_energy_;  ///< J, over which errors of energy are counted at least
  EnergyMonitor<Dim> energy_;
  double deepest_behind_piston_ = 0;
};

}  // namespace mpm
