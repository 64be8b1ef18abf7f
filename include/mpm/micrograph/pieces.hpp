#pragma once
/// Connected pieces of the filled locations. Two locations are connected if they share an edge; a
/// common corner is not enough.

#include <mpm/micrograph/specimen.hpp>

namespace mpm::micrograph {

struct Pieces {
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> label;  ///< per location: number of its piece, or `none` where void
  std::vector<std::int64_t> size;   ///< per piece: locations
};

/// Pieces are numbered in the order of their first location. Materials are not told apart.
Pieces connected_pieces(const Lattice& lattice);

/// Both return the number of locations they emptied.
std::int64_t remove_specks(Lattice& lattice, std::int64_t fewest_locations);
/// The first of several equally large pieces stays.
std::int64_t keep_largest_piece(Lattice& lattice);

}  // namespace mpm::micrograph
