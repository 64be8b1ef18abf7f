#include <mpm/micrograph/gaps.hpp>

#include <algorithm>

namespace mpm::micrograph {

template <int Dim>
Gaps gaps_along(const Specimen<Dim>& specimen, std::span<const scene::Material> materials, int axis,
                const Share& share)
{
  constexpr GlobalIndex chunk_locations = 1 << 22;  // held at a time
  const int cell = specimen.particles_per_cell();
  Gaps gaps;
  gaps.layers.resize(std::size_t(specimen.count()[axis]));
  double lost = 0;  // empty locations within a cell behind a filled one
  for_each_chunk(
      slab(specimen.whole(), share.part, share.parts), chunk_locations,
      [&](const IndexBox<Dim>& chunk) {
        IndexBox<Dim> seen = chunk;
        seen.lower[axis] = std::max(0, seen.lower[axis] - cell);
        const Lattice<Dim> lattice = specimen.lattice(seen);
        for_each_index(chunk, [&](IndexVec<Dim> at) {
          const int begin = at[axis];
          const std::int8_t here = lattice(at);
          if (here != lattice.empty) {
            gaps.layers[std::size_t(begin)] += materials[std::size_t(here)].law->deformable();
            return;
          }
          while (at[axis] >= 0 && begin - at[axis] < cell && lattice(at) == lattice.empty)
            --at[axis];
          lost += at[axis] >= 0 && lattice(at) != lattice.empty;
        });
      });
  share.sum(gaps.layers);
  share.sum({&lost, 1});
  gaps.early_contact = lost / double(specimen.whole().size());
  return gaps;
}

template Gaps gaps_along(const Specimen<2>&, std::span<const scene::Material>, int, const Share&);
template Gaps gaps_along(const Specimen<3>&, std::span<const scene::Material>, int, const Share&);

}  // namespace mpm::micrograph
