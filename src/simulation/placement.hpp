#pragma once
/// Where a scene's parts lie, for those who build the run from it.

#include <mpm/micrograph/specimen.hpp>
#include <mpm/scene/scene.hpp>
#include <mpm/simulation/model.hpp>

#include <array>
#include <cstddef>

namespace mpm {

/// Initial velocity of the particle at a location, m/s.
std::array<double, 2> initial_velocity(const scene::Scene& scene,
                                       const micrograph::Lattice<2>& lattice, std::size_t location);

/// The load cell: elastic like the first deformable material, stiffer and denser by the same
/// ratio, so that waves run through it as fast as through the wood.
scene::Material load_cell_material(const scene::Scene& scene, double ratio);

/// Cell along axis d of a location counted from the specimen's lower left corner.
inline LocalIndex cell_of_location(const Layout& layout, int particles_per_cell, int location,
                                   int d)
{
  const int cells =
      location >= 0 ? location / particles_per_cell : (location + 1) / particles_per_cell - 1;
  return layout.padding[d] + cells;
}

/// One of so many equal slabs of the rows of locations.
struct RowShare {
  int part = 0, parts = 1;
};

/// visit(cell) for each particle in a share of the rows.
template <class Visit>
void for_each_particle_cell(const scene::Scene& scene, const micrograph::Specimen<2>& specimen,
                            const Layout& layout, RowShare share, Visit visit)
{
  constexpr GlobalIndex chunk_locations = 1 << 22;  // held at a time
  const int per_cell = specimen.particles_per_cell();
  const auto visit_location = [&](int i, int j) {
    visit(IndexVec<2>(cell_of_location(layout, per_cell, i, 0),
                      cell_of_location(layout, per_cell, j, 1)));
  };
  const IndexBox<2> own = micrograph::slab(specimen.whole(), share.part, share.parts);
  micrograph::for_each_chunk(own, chunk_locations, [&](const IndexBox<2>& chunk) {
    const micrograph::Lattice<2> lattice = specimen.lattice(chunk);
    for_each_index(chunk, [&](const IndexVec<2>& at) {
      const std::int8_t material = lattice(at);
      if (material != lattice.empty && scene.materials[material].law != scene::Law::rigid)
        visit_location(at[0], at[1]);
    });
  });
  if (!layout.load_cell || share.part != 0) return;
  const IndexBox<2>& box = layout.load_cell->locations;
  for (int j = box.lower[1]; j < box.upper[1]; ++j)
    for (int i = box.lower[0]; i < box.upper[0]; ++i) visit_location(i, j);
}

}  // namespace mpm
