#include <mpm/micrograph/early_contact.hpp>

#include <algorithm>

namespace mpm::micrograph {

template <int Dim>
double early_contact(const Specimen<Dim>& specimen, int axis, const Share& share)
{
  constexpr GlobalIndex chunk_locations = 1 << 22;  // held at a time
  const int cell = specimen.particles_per_cell();
  double lost = 0;  // empty locations within a cell behind a filled one
  for_each_chunk(
      slab(specimen.whole(), share.part, share.parts), chunk_locations,
      [&](const IndexBox<Dim>& chunk) {
        IndexBox<Dim> seen = chunk;
        seen.lower[axis] = std::max(0, seen.lower[axis] - cell);
        const Lattice<Dim> lattice = specimen.lattice(seen);
        for_each_index(chunk, [&](IndexVec<Dim> at) {
          const int begin = at[axis];
          while (at[axis] >= 0 && begin - at[axis] < cell && lattice(at) == lattice.empty)
            --at[axis];
          lost += at[axis] < begin && at[axis] >= 0 && lattice(at) != lattice.empty;
        });
      });
  share.sum({&lost, 1});
  return lost / double(specimen.whole().size());
}

template double early_contact(const Specimen<2>&, int, const Share&);
template double early_contact(const Specimen<3>&, int, const Share&);

}  // namespace mpm::micrograph
