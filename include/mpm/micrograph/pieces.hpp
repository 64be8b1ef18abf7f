#pragma once
/// Connected pieces of the filled locations of a section. Two locations are connected if they share
/// an edge; a common corner is not enough.

#include <mpm/micrograph/lattice.hpp>
#include <mpm/micrograph/share.hpp>

namespace mpm::micrograph {

/// The pieces of one part on its own.
struct Pieces {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> label;  ///< per location: number of its piece, or `none` where void
  std::vector<std::int64_t> size;   ///< per piece: locations
  std::vector<GlobalIndex> first;   ///< per piece: number of its first location in the whole
};

/// Pieces are numbered in the order of their first location. Materials are not told apart.
Pieces connected_pieces(const Lattice<2>& lattice);

/// Which pieces stay.
struct PieceRules {
  std::int64_t fewest_locations = 0;
  bool only_largest = false;  ///< of those that are large enough; the first of equals
};

/// Locations [begin, end) of a row.
struct Run {
  LocalIndex row, begin, end;
};

/// What the rules remove from a section of which each part holds its slab (whole rows), in the
/// order of the locations; all of it on every part. Pieces are those of the whole section: parts
/// tell each other their first and last row, 32 bytes per location of it, and what they remove.
/// Collective.
std::vector<Run> removed_runs(const Lattice<2>& rows, const PieceRules& rules, const Share& share);

}  // namespace mpm::micrograph
