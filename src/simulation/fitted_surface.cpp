#include <mpm/micrograph/fitted_corners.hpp>
#include <mpm/simulation/fitted_surface.hpp>

namespace mpm {

template <>
CornerOffsets<2> surface_offsets(const scene::Scene& scene, const micrograph::Specimen<2>& specimen,
                                 const Layout<2>& layout, const IndexBox<2>& part)
{
  if (scene.numerics.surface == scene::Surface::stairs) return {};
  IndexBox<2> seen = part;
  for (int d = 0; d < 2; ++d) {
    const bool periodic = layout.geometry.periodic[d];
    seen.lower[d] = periodic ? 0 : part.lower[d] - micrograph::fitting_reach - 1;
    seen.upper[d] = periodic ? specimen.count()[d] : part.upper[d] + micrograph::fitting_reach + 1;
  }
  const micrograph::Lattice<2> lattice = specimen.lattice(intersection(seen, specimen.whole()));
  const std::array<bool, 2> periodic{layout.geometry.periodic[0], layout.geometry.periodic[1]};
  const auto of_load_cell = [&](const IndexVec<2>& corner) {
    if (!layout.load_cell) return false;
    const IndexBox<2>& box = layout.load_cell->locations;
    return (corner.array() >= box.lower.array()).all() &&
           (corner.array() <= box.upper.array()).all();
  };
  return micrograph::fitted_corners(
      part,
      {specimen.count(), layout.location_size, periodic,
       [&](const IndexVec<2>& location) -> int { return lattice(location); }, of_load_cell},
      *specimen.wall_places(periodic));
}

template <>
CornerOffsets<3> surface_offsets(const scene::Scene&, const micrograph::Specimen<3>&,
                                 const Layout<3>&, const IndexBox<3>&)
{
  return {};
}

}  // namespace mpm
