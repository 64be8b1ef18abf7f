#include <mpm/core/error.hpp>
#include <mpm/micrograph/geometry.hpp>
#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/material_names.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mpm::micrograph {

namespace {

constexpr std::array axis_name{'x', 'y'};
// Locations, and the pieces they form, are numbered by 32-bit integers.
constexpr double most_locations = std::numeric_limits<std::int32_t>::max();

double centre(int index, int count)
{
  return (index + 0.5) / count;
}

/// Range [first, last) of locations whose centres can lie between two coordinates (m); one more on
/// either side, so that rounding here decides nothing.
std::array<int, 2> locations_between(double lower, double upper, double length, int count)
{
  const double first = std::floor(lower / length * count) - 1;
  const double last = std::ceil(upper / length * count) + 1;
  return {int(std::clamp(first, 0.0, double(count))), int(std::clamp(last, 0.0, double(count)))};
}

}  // namespace

std::array<int, 2> cell_counts(const scene::Grid& grid, const std::array<double, 2>& size)
{
  if (grid.cells && grid.spacing)
    throw InputError("grid.cells and grid.spacing are both given. Give one of them.");
  if (grid.cells) {
    for (std::size_t d = 0; d < 2; ++d)
      if ((*grid.cells)[d] < 1)
        throw InputError(
            fmt::format("grid.cells[{}] is {} (must be at least 1).", d, (*grid.cells)[d]));
    return *grid.cells;
  }
  const double default_spacing = size[0] / 150;
  const std::array<double, 2> spacing =
      grid.spacing.value_or(std::array{default_spacing, default_spacing});
  std::array<int, 2> cells{};
  for (std::size_t d = 0; d < 2; ++d) {
    if (!(spacing[d] > 0))
      throw InputError(fmt::format("grid.spacing[{}] is {} m (must be above 0).", d, spacing[d]));
    const double count = std::max(1.0, std::round(size[d] / spacing[d]));
    if (count > most_locations)
      throw InputError(fmt::format(
          "grid.spacing[{}] is {} m, which makes {:.3g} cells along {}. Give a coarser one.", d,
          spacing[d], count, axis_name[d]));
    cells[d] = int(count);
  }
  return cells;
}

Lattice empty_lattice(const std::array<int, 2>& cells, int particles_per_cell)
{
  if (particles_per_cell < 1)
    throw InputError(
        fmt::format("grid.particles_per_cell is {} (must be at least 1).", particles_per_cell));
  const double nx = double(cells[0]) * particles_per_cell;
  const double ny = double(cells[1]) * particles_per_cell;
  if (nx * ny > most_locations)
    throw InputError(fmt::format(
        "grid.cells are {} x {} with {} x {} particle locations each, {:.3g} in all (at "
        "most {:.0f}). Give fewer.",
        cells[0], cells[1], particles_per_cell, particles_per_cell, nx * ny, most_locations));
  Lattice lattice;
  lattice.nx = int(nx);
  lattice.ny = int(ny);
  lattice.material.assign(std::size_t(nx * ny), Lattice::empty);
  return lattice;
}

void fill_with_shapes(Lattice& lattice, const scene::Scene& scene)
{
  const scene::Specimen& specimen = scene.specimen;
  const auto [width, height] = specimen.size;
  const MaterialNames materials(scene.materials);
  if (specimen.shapes.size() > std::size_t(std::numeric_limits<std::int16_t>::max()))
    throw InputError(fmt::format("specimen.shapes has {} entries. At most {} can be told apart.",
                                 specimen.shapes.size(), std::numeric_limits<std::int16_t>::max()));
  lattice.shape.assign(lattice.material.size(), -1);

  for (std::size_t number = 0; number < specimen.shapes.size(); ++number) {
    const scene::Shape& shape = specimen.shapes[number];
    const std::string key = fmt::format("specimen.shapes[{}]", number);
    if (const std::string fault = defect(shape); !fault.empty())
      throw InputError(fmt::format("{}: {}.", key, fault));
    const std::int8_t material = materials.index(shape.material, key + ".material");
    const bool filled = material != Lattice::empty;

    const scene::Box box = bounds(shape);
    const auto [i0, i1] = locations_between(box.lower[0], box.upper[0], width, lattice.nx);
    const auto [j0, j1] = locations_between(box.lower[1], box.upper[1], height, lattice.ny);
    bool found = false;
    std::visit(
        [&](const auto& geometry) {
          for (int j = j0; j < j1; ++j)
            for (int i = i0; i < i1; ++i) {
              const Point point{centre(i, lattice.nx) * width, centre(j, lattice.ny) * height};
              if (!contains(geometry, point)) continue;
              const std::size_t location = std::size_t(j) * lattice.nx + i;
              lattice.material[location] = material;
              lattice.shape[location] = filled ? std::int16_t(number) : std::int16_t(-1);
              found = true;
            }
        },
        shape.geometry);
    if (!found)
      throw InputError(fmt::format(
          "{} contains no particle location of the specimen ({} x {} m, lattice {} x {}). "
          "Move or enlarge it, or refine the grid.",
          key, width, height, lattice.nx, lattice.ny));
  }
}

std::vector<RelativeDensity> densities(const Lattice& lattice, const scene::Scene& scene)
{
  std::vector<scene::Window> windows = scene.specimen.windows;
  windows.insert(windows.begin(), scene::Window{"", {0, 1}, {0, 1}});
  std::vector<RelativeDensity> result;
  for (std::size_t number = 0; number < windows.size(); ++number) {
    const scene::Window& window = windows[number];
    double locations = 0, filled = 0, density_sum = 0;
    for (int j = 0; j < lattice.ny; ++j) {
      const double y = centre(j, lattice.ny);
      if (y < window.y[0] || y >= window.y[1]) continue;
      for (int i = 0; i < lattice.nx; ++i) {
        const double x = centre(i, lattice.nx);
        if (x < window.x[0] || x >= window.x[1]) continue;
        locations += 1;
        const std::int8_t material = lattice(i, j);
        if (material == Lattice::empty) continue;
        filled += 1;
        density_sum += scene.materials[std::size_t(material)].density();
      }
    }
    if (locations == 0)
      throw InputError(fmt::format(
          "specimen.windows[{}] '{}' is x [{}, {}], y [{}, {}] and contains no location. "
          "Give growing fractions between 0 and 1.",
          number - 1, window.name, window.x[0], window.x[1], window.y[0], window.y[1]));
    result.push_back({window.name, filled / locations, density_sum / locations});
  }
  return result;
}

}  // namespace mpm::micrograph
