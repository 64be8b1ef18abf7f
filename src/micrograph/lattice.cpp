#include <mpm/core/error.hpp>
#include <mpm/micrograph/lattice.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

// What a part holds is numbered by 32-bit integers, and so are the locations along an axis.
constexpr double most_locations = std::numeric_limits<LocalIndex>::max();

/// `150 x 97`
template <int Dim>
std::string product(const IndexVec<Dim>& counts)
{
  std::string text = std::to_string(counts[0]);
  for (int d = 1; d < Dim; ++d) text += " x " + std::to_string(counts[d]);
  return text;
}

}  // namespace

template <int Dim>
IndexVec<Dim> cell_counts(const scene::Grid& grid, const Vec<Dim>& size)
{
  if (grid.cells && grid.spacing)
    throw InputError("grid.cells and grid.spacing are both given. Give one of them.");
  IndexVec<Dim> cells;
  for (int d = 0; d < Dim; ++d) {
    const auto axis = std::size_t(d);
    if (grid.cells) {
      cells[d] = (*grid.cells)[axis];
      if (cells[d] < 1)
        throw InputError(fmt::format("grid.cells[{}] is {} (must be at least 1).", d, cells[d]));
      continue;
    }
    const double spacing = grid.spacing ? (*grid.spacing)[axis] : size[0] / 150;
    if (!(spacing > 0))
      throw InputError(fmt::format("grid.spacing[{}] is {} m (must be above 0).", d, spacing));
    const double count = std::max(1.0, std::round(size[d] / spacing));
    if (count > most_locations)
      throw InputError(fmt::format(
          "grid.spacing[{}] is {} m, which makes {:.3g} cells along {}. Give a coarser one.", d,
          spacing, count, "xyz"[d]));
    cells[d] = LocalIndex(count);
  }
  return cells;
}

template <int Dim>
IndexVec<Dim> location_counts(const IndexVec<Dim>& cells, int particles_per_cell, int parts)
{
  if (particles_per_cell < 1)
    throw InputError(
        fmt::format("grid.particles_per_cell is {} (must be at least 1).", particles_per_cell));
  const double locations = cells.template cast<double>().prod() * std::pow(particles_per_cell, Dim);
  const double longest = double(cells.maxCoeff()) * particles_per_cell;
  if (locations > most_locations * parts || longest > most_locations)
    throw InputError(fmt::format(
        "grid.cells are {} with {} particle locations each, {:.3g} in all (at most {:.0f} per "
        "rank). Give fewer, or use more ranks.",
        product<Dim>(cells), product<Dim>(IndexVec<Dim>::Constant(particles_per_cell)), locations,
        most_locations));
  return cells * particles_per_cell;
}

template IndexVec<2> cell_counts<2>(const scene::Grid&, const Vec<2>&);
template IndexVec<3> cell_counts<3>(const scene::Grid&, const Vec<3>&);
template IndexVec<2> location_counts<2>(const IndexVec<2>&, int, int);
template IndexVec<3> location_counts<3>(const IndexVec<3>&, int, int);

}  // namespace mpm::micrograph
