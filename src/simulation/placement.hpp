#pragma once
/// Where a scene's parts lie, for those who build the run from it.

#include <mpm/micrograph/specimen.hpp>
#include <mpm/scene/scene.hpp>
#include <mpm/simulation/model.hpp>

#include <array>
#include <cstddef>

namespace mpm {

inline int axis_of(scene::Side side)
{
  return side == scene::Side::left || side == scene::Side::right ? 0 : 1;
}
inline bool upper_of(scene::Side side)
{
  return side == scene::Side::right || side == scene::Side::top;
}

/// Initial velocity of the particle at a location, m/s.
std::array<double, 2> initial_velocity(const scene::Scene& scene,
                                       const micrograph::Lattice& lattice, std::size_t location);

/// The load cell: elastic like the first deformable material, stiffer and denser by the same
/// ratio, so that waves run through it as fast as through the wood.
scene::Material load_cell_material(const scene::Scene& scene, double ratio);

/// Law of a deformable material.
inline std::unique_ptr<Law<2>> law_of(const scene::Material& material, const scene::Scene& scene)
{
  return make_law<2>(*material.law, material.values, scene.numerics.plane);
}

/// Prescribed velocity of a material that cannot be deformed, m/s.
inline std::array<double, 2> velocity_of(const scene::Material& material)
{
  const std::vector<double>& v = material.values.vector("velocity");
  return {v[0], v[1]};
}

/// Cell along axis d of a location counted from the specimen's lower left corner.
inline LocalIndex cell_of_location(const Layout& layout, int particles_per_cell, int location,
                                   int d)
{
  const int cells =
      location >= 0 ? location / particles_per_cell : (location + 1) / particles_per_cell - 1;
  return layout.padding[d] + cells;
}

/// One of so many equal shares of the rows of locations.
struct RowShare {
  int part = 0, parts = 1;
};

/// visit(cell) for each particle in a share of the rows.
template <class Visit>
void for_each_particle_cell(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
                            const Layout& layout, RowShare share, Visit visit)
{
  const int per_cell = specimen.particles_per_cell;
  const auto visit_location = [&](int i, int j) {
    visit(IndexVec<2>(cell_of_location(layout, per_cell, i, 0),
                      cell_of_location(layout, per_cell, j, 1)));
  };
  const micrograph::Lattice& lattice = specimen.lattice;
  for (int j = share.part; j < lattice.ny; j += share.parts)
    for (int i = 0; i < lattice.nx; ++i)
      if (lattice(i, j) != micrograph::Lattice::empty &&
          scene.materials[lattice(i, j)].law->deformable())
        visit_location(i, j);
  if (!layout.load_cell || share.part != 0) return;
  const IndexBox<2>& box = layout.load_cell->locations;
  for (int j = box.lower[1]; j < box.upper[1]; ++j)
    for (int i = box.lower[0]; i < box.upper[0]; ++i) visit_location(i, j);
}

}  // namespace mpm
