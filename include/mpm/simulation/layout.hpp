#pragma once
/// Where a scene's parts lie on the grid: what does not depend on the rank.

#include <mpm/conditions/wall_motion.hpp>
#include <mpm/grid/grid_geometry.hpp>
#include <mpm/materials/laws.hpp>
#include <mpm/micrograph/specimen.hpp>
#include <mpm/scene/scene.hpp>

#include <array>
#include <optional>

namespace mpm {

/// The specimen's lower corner is the origin of coordinates.
template <int Dim>
struct Layout {
  GridGeometry<Dim> geometry;
  Vec<Dim> location_size;        ///< m
  IndexVec<Dim> padding;         ///< cells below the specimen along each axis
  int per_cell;                  ///< locations per cell and direction
  double particle_volume;        ///< m^3
  double largest_particle_mass;  ///< kg
  double wave_speed;             ///< m/s, of the stiffest body
  double cfl;
  double crossed_in_step;  ///< m, the way of the fastest wave in a step of CFL 1
  double largest_speed;    ///< m/s, initial, or of what is moved
  /// Of the piston, towards the specimen; and the time at which the run ends, s.
  WallMotion piston;
  double end_time;
  /// Its locations, counted from the specimen's lower corner.
  struct LoadCellBox {
    IndexBox<Dim> locations;
    double density_ratio;
  };
  std::optional<LoadCellBox> load_cell;
  /// Cell along an axis of a location counted from the specimen's lower corner.
  LocalIndex cell_of_location(LocalIndex location, int axis) const
  {
    const LocalIndex cells = location >= 0 ? location / per_cell : (location + 1) / per_cell - 1;
    return padding[axis] + cells;
  }
  IndexVec<Dim> cell_of_location(const IndexVec<Dim>& location) const
  {
    IndexVec<Dim> cell;
    for (int d = 0; d < Dim; ++d) cell[d] = cell_of_location(location[d], d);
    return cell;
  }
};

/// Throws InputError, e.g. for a law that is not there in the plane or in space.
template <int Dim>
Layout<Dim> make_layout(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen);

/// Time at which the piston has travelled a share of the specimen's length (m), s.
double time_of_strain(const WallMotion& piston, double length, double strain);

/// Law of a deformable material.
template <int Dim>
std::unique_ptr<Law<Dim>> law_of(const scene::Material& material, const scene::Scene& scene)
{
  return make_law<Dim>(*material.law, material.values, scene.numerics.plane);
}

/// Of a rigid material, along each axis.
template <int Dim>
std::array<WallMotion, Dim> motion_of(const scene::Material& rigid);

/// The load cell: elastic like the first deformable material, stiffer and denser by the same
/// ratio, so that waves run through it as fast as through the wood.
scene::Material load_cell_material(const scene::Scene& scene, double ratio);

/// visit(cell) for each particle in one of `parts` slabs of the locations.
template <int Dim, class Visit>
void for_each_particle_cell(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                            const Layout<Dim>& layout, int part, int parts, Visit visit)
{
  constexpr GlobalIndex chunk_locations = 1 << 22;  // held at a time
  const IndexBox<Dim> own = micrograph::slab(specimen.whole(), part, parts);
  micrograph::for_each_chunk(own, chunk_locations, [&](const IndexBox<Dim>& chunk) {
    const micrograph::Lattice<Dim> lattice = specimen.lattice(chunk);
    std::size_t place = 0;
    for_each_index(chunk, [&](const IndexVec<Dim>& at) {
      const std::int8_t material = lattice.material[place++];
      if (material != lattice.empty && scene.materials[material].law->deformable())
        visit(layout.cell_of_location(at));
    });
  });
  if (!layout.load_cell) return;
  for_each_index(micrograph::slab(layout.load_cell->locations, part, parts),
                 [&](const IndexVec<Dim>& at) { visit(layout.cell_of_location(at)); });
}

}  // namespace mpm
