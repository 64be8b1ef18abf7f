#pragma once
/// Connected pieces of the filled locations of a section or a stack. Two locations are connected if
/// they share an edge, in space a face; a common corner is not enough.

#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/share.hpp>

#include <array>

namespace mpm::micrograph {

/// Axes whose upper side a specimen's lower one goes on from.
using PeriodicAxes = std::array<bool, 3>;

/// The pieces of one part on its own.
struct Pieces {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> label;  ///< per location: number of its piece, or `none` where void
  std::vector<std::int64_t> size;   ///< per piece: locations
  std::vector<GlobalIndex> first;   ///< per piece: number of its first location in the whole
};

/// Pieces are numbered in the order of their first location. Materials are not told apart. Pieces
/// hang together across periodic axes along which the part is the whole.
template <int Dim>
Pieces connected_pieces(const Lattice<Dim>& lattice, const PeriodicAxes& periodic = {});

/// Which pieces stay.
struct PieceRules {
  std::int64_t fewest_locations = 0;
  bool only_largest = false;  ///< of those that are large enough; the first of equals
  PeriodicAxes periodic{};

  bool remove_something() const { return fewest_locations > 1 || only_largest; }
};

/// Locations [begin, end) of a row along x; rows are numbered upwards, in space layer by layer.
struct Run {
  GlobalIndex row;
  LocalIndex begin, end;
};

/// What the rules remove from a specimen of which each part holds its slab (whole rows, in space
/// whole layers), in the order of the locations; all of it on every part. Pieces are those of the
/// whole specimen: parts tell each other their first and last row or layer, 32 bytes per location
/// of it, and what they remove. Collective.
template <int Dim>
std::vector<Run> removed_runs(const Lattice<Dim>& slab_of_part, const PieceRules& rules,
                              const Share& share);

extern template Pieces connected_pieces<2>(const Lattice<2>&, const PeriodicAxes&);
extern template Pieces connected_pieces<3>(const Lattice<3>&, const PeriodicAxes&);
extern template std::vector<Run> removed_runs<2>(const Lattice<2>&, const PieceRules&,
                                                 const Share&);
extern template std::vector<Run> removed_runs<3>(const Lattice<3>&, const PieceRules&,
                                                 const Share&);

}  // namespace mpm::micrograph
