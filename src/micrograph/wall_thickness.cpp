#include <mpm/micrograph/mirrored.hpp>
#include <mpm/micrograph/wall_thickness.hpp>

#include <algorithm>
#include <array>

namespace mpm::micrograph {

namespace {

/// Offsets of the locations of a disc of so many locations across, centres within its radius.
template <int Dim>
std::vector<IndexVec<Dim>> disc_of(int across)
{
  std::vector<IndexVec<Dim>> disc;
  const IndexBox<Dim> square{IndexVec<Dim>::Zero(), IndexVec<Dim>::Constant(across)};
  for_each_index(square, [&](const IndexVec<Dim>& at) {
    int squared = 0;  // of twice the distance
    for (int d = 0; d < Dim; ++d) squared += (2 * at[d] + 1 - across) * (2 * at[d] + 1 - across);
    if (squared <= across * across) disc.push_back(at);
  });
  return disc;
}

/// Of a location beyond the specimen the one that stands for it.
template <int Dim>
IndexVec<Dim> within(IndexVec<Dim> at, const IndexVec<Dim>& count)
{
  for (int d = 0; d < Dim; ++d) at[d] = mirrored(at[d], count[d]);
  return at;
}

}  // namespace

template <int Dim>
ThinCount count_thin(const Specimen<Dim>& specimen, std::span<const scene::Material> materials,
                     const IndexBox<Dim>& part, int cells)
{
  const int across = cells * specimen.particles_per_cell();
  // A disc is known by the first corner of the square around it.
  const IndexBox<Dim> first{part.lower - IndexVec<Dim>::Constant(across - 1), part.upper};
  const IndexBox<Dim> seen{first.lower, part.upper + IndexVec<Dim>::Constant(across - 1)};
  const Lattice<Dim> lattice = specimen.lattice(intersection(seen, specimen.whole()));
  std::vector<char> filled, covered(std::size_t(seen.size()), 0);
  filled.reserve(covered.size());
  for_each_index(seen, [&](const IndexVec<Dim>& at) {
    filled.push_back(lattice(within<Dim>(at, specimen.count())) != lattice.empty);
  });
  std::vector<LocalIndex> disc;
  for (const IndexVec<Dim>& offset : disc_of<Dim>(across))
    disc.push_back(number_in(seen, IndexVec<Dim>(seen.lower + offset)));
  for_each_index(first, [&](const IndexVec<Dim>& at) {
    const LocalIndex corner = number_in(seen, at);
    if (std::ranges::all_of(disc, [&](LocalIndex k) { return filled[corner + k]; }))
      for (const LocalIndex k : disc) covered[corner + k] = 1;
  });
  ThinCount count;
  for_each_index(part, [&](const IndexVec<Dim>& at) {
    const std::int8_t material = lattice(at);
    if (material == lattice.empty || !materials[std::size_t(material)].law->deformable()) return;
    ++count.filled;
    count.thin += !covered[number_in(seen, at)];
  });
  return count;
}

template <int Dim>
ThinCount count_thin(const Specimen<Dim>& specimen, std::span<const scene::Material> materials,
                     int cells, const Share& share)
{
  constexpr GlobalIndex chunk_locations = 1 << 20;  // held at a time
  std::array<double, 2> sums{};
  for_each_chunk(slab(specimen.whole(), share.part, share.parts), chunk_locations,
                 [&](const IndexBox<Dim>& chunk) {
                   const ThinCount count = count_thin(specimen, materials, chunk, cells);
                   sums[0] += double(count.filled);
                   sums[1] += double(count.thin);
                 });
  share.sum(sums);
  return {GlobalIndex(sums[0]), GlobalIndex(sums[1])};
}

template ThinCount count_thin(const Specimen<2>&, std::span<const scene::Material>,
                              const IndexBox<2>&, int);
template ThinCount count_thin(const Specimen<3>&, std::span<const scene::Material>,
                              const IndexBox<3>&, int);
template ThinCount count_thin(const Specimen<2>&, std::span<const scene::Material>, int,
                              const Share&);
template ThinCount count_thin(const Specimen<3>&, std::span<const scene::Material>, int,
                              const Share&);

}  // namespace mpm::micrograph
