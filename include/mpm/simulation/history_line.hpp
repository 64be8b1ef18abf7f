#pragma once
/// What the history holds at one moment.

#include <mpm/core/archive.hpp>
#include <mpm/core/types.hpp>
#include <mpm/output/history.hpp>

#include <vector>

namespace mpm {

/// One line of history.csv.
struct HistoryLine {
  double time = 0;              ///< s
  double strain = 0;            ///< piston displacement / specimen length
  double piston_stress = 0;     ///< Pa, mean since the last line, compression positive
  double edge_stress = 0;       ///< Pa
  double load_cell_stress = 0;  ///< Pa, where there is a load cell
  GlobalIndex particles = 0;
  double kinetic_energy = 0;  ///< J
  double elastic_energy = 0;  ///< J
  double plastic_work = 0;    ///< J
  double external_work = 0;   ///< J, of all loads, contacts and conditions
  /// What is too much in the energy balance, all of it at the moment of the velocities, / external
  /// work.
  double energy_error = 0;
  /// |momentum gained - impulse from outside| / (sum of the impulses' sizes + momentum at the
  /// start): rounding, unless something is lost.
  double momentum_error = 0;
  double contact_energy = 0;      ///< J
  double overlapped_area = 0;     ///< m^2, in space volume, m^3
  double deepest_overlap = 0;     ///< of a cell or location
  GlobalIndex contact_pairs = 0;  ///< of cells, or particle and wall
  double friction_work = 0;       ///< J, in contact between bodies, since the start
  GlobalIndex failed_cells = 0;   ///< since the start
  double failed_energy = 0;       ///< J, that they had stored
  double added_mass = 0;          ///< of the cells' own, by which they are heavier at present
  double time_step = 0;           ///< s
  GlobalIndex behind_piston = 0, outside_walls = 0;  ///< particles

  /// The applied stress: mean of both ends, in which a wave on its way counts once.
  double stress() const { return 0.5 * (piston_stress + edge_stress); }
};

/// What a history can have: stresses with a piston, one more with a load cell; contact; friction;
/// cells that fail; cells that are made heavier.
struct HistoryKind {
  bool piston = false, load_cell = false, contact = false, friction = false, space = false,
       failure = false, added_mass = false;
};
std::vector<output::HistoryColumn> history_columns(const HistoryKind& kind);
std::vector<double> history_row(const HistoryLine& line, const HistoryKind& kind);
void archive_lines(Archive& archive, std::vector<HistoryLine>& lines);

}  // namespace mpm
