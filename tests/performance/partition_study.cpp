/// Balance and messages of a block of wood-like tubes in space on 8, 64 and 512 ranks, with cuts
/// and with METIS, before and after it is squeezed to half of its length: the table that `mpm_par
/// --check --ranks` prints for a scene in the plane. Needs one process:
///     build/partition_study [cells per edge]

#include <mpm/parallel/partition_report.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace {

using namespace mpm;

constexpr int per_cell = 2;           ///< particles per cell and direction
constexpr double tube_width = 12;     ///< cells, between the middles of opposite walls
constexpr double wall_thickness = 2;  ///< cells

/// Whether a place lies in a wall of a hexagonal honeycomb: walls are where the distances to the
/// two nearest tube axes differ by less than the thickness allows.
bool in_wall(double x, double y)
{
  const double row_height = tube_width * std::sqrt(0.75);
  double nearest = 1e300, second = 1e300;
  const int row = int(std::floor(y / row_height));
  for (int j = row - 1; j <= row + 2; ++j) {
    const double shift = j % 2 == 0 ? 0.0 : 0.5 * tube_width;
    const int column = int(std::floor((x - shift) / tube_width));
    for (int i = column - 1; i <= column + 2; ++i) {
      const double dx = x - shift - i * tube_width, dy = y - j * row_height;
      const double square = dx * dx + dy * dy;
      if (square < nearest)
        second = nearest, nearest = square;
      else
        second = std::min(second, square);
    }
  }
  return (second - nearest) / (2 * tube_width) < 0.5 * wall_thickness;
}

/// Tubes along z, squeezed along x to this share of their length.
CellVisits<3> tubes(int cells, double share)
{
  return [=](const std::function<void(const IndexVec<3>&)>& visit) {
    constexpr LocalIndex margin = 2;
    for (int j = 0; j < per_cell * cells; ++j)
      for (int i = 0; i < per_cell * cells; ++i) {
        const double x = (i + 0.5) / per_cell, y = (j + 0.5) / per_cell;
        if (!in_wall(x, y)) continue;
        for (int k = 0; k < per_cell * cells; ++k)
          visit({margin + LocalIndex(share * x), margin + LocalIndex(y),
                 margin + LocalIndex(k / per_cell)});
      }
  };
}

}  // namespace

int main(int argc, char** argv)
{
  const int cells = argc > 1 ? std::atoi(argv[1]) : 128;
  if (cells < 16) {
    fmt::print(stderr, "usage: partition_study [cells per edge, at least 16]\n");
    return 2;
  }
  const GridGeometry<3> grid{Vec<3>::Zero(), Vec<3>::Ones(), IndexVec<3>::Constant(cells + 5)};
  constexpr int support = 3, piston_axis = 0;
  const CellVisits<3> start = tubes(cells, 1.0);
  const double particles = loads_of<3>(weighted_cuts<3>(grid, 1, {0, 0, 0}, {}, {}), start)[0];
  fmt::print("{} x {} x {} cells, {:.0f} particles, relative density {:.3f}\n", cells, cells, cells,
             particles, particles / std::pow(double(per_cell) * cells, 3));
  fmt::print("{}", partition_table<3>(grid, {8, 64, 512},
                                      {PartitionKind::automatic, {0, 0, 0}, piston_axis},
                                      grid_reporter<3>(support), start, tubes(cells, 0.5)));
  return 0;
}
