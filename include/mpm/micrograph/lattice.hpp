#pragma once
/// The lattice of particle locations: how fine it is, and what fills a part of it.

#include <mpm/core/index_box.hpp>
#include <mpm/scene/scene.hpp>

#include <cstdint>
#include <vector>

namespace mpm::micrograph {

/// A part of the regular lattice of particle locations over the specimen. x runs fastest, the
/// specimen's lower corner comes first (images are stored top row first: rastering turns them
/// over).
template <int Dim>
struct Lattice {
  static constexpr std::int8_t empty = -1;
  IndexVec<Dim> count =
      IndexVec<Dim>::Zero();          ///< of the whole specimen: cells x particles_per_cell
  IndexBox<Dim> part{};               ///< the locations held
  std::vector<std::int8_t> material;  ///< index into scene.materials, or `empty`; one per location
  std::vector<std::int16_t> shape;    ///< index into specimen.shapes, or -1; empty for images

  /// Place of a location of the part in `material` and `shape`.
  std::size_t place(const IndexVec<Dim>& location) const
  {
    return std::size_t(number(location - part.lower, part.count()));
  }
  std::int8_t operator()(const IndexVec<Dim>& location) const { return material[place(location)]; }
  /// Number of a location in the whole lattice, x fastest: the same whatever part is held.
  GlobalIndex id(const IndexVec<Dim>& location) const { return number(location, count); }

 private:
  static GlobalIndex number(const IndexVec<Dim>& at, const IndexVec<Dim>& count)
  {
    GlobalIndex result = 0;
    for (int d = Dim; d-- > 0;) result = result * count[d] + at[d];
    return result;
  }
};

/// Cells over a specimen of this size (m): as given, or the whole numbers nearest to the spacing
/// asked for; with neither, 150 along x and nearly equal edges. Throws InputError.
template <int Dim>
IndexVec<Dim> cell_counts(const scene::Grid& grid, const Vec<Dim>& size);

/// Locations of the whole specimen along each axis. Throws InputError for more of them than the
/// parts together can number.
template <int Dim>
IndexVec<Dim> location_counts(const IndexVec<Dim>& cells, int particles_per_cell, int parts);

/// Centre of a location as a fraction of the specimen's edge.
constexpr double centre(int index, int count)
{
  return (index + 0.5) / count;
}

extern template IndexVec<2> cell_counts<2>(const scene::Grid&, const Vec<2>&);
extern template IndexVec<3> cell_counts<3>(const scene::Grid&, const Vec<3>&);
extern template IndexVec<2> location_counts<2>(const IndexVec<2>&, int, int);
extern template IndexVec<3> location_counts<3>(const IndexVec<3>&, int, int);

}  // namespace mpm::micrograph
