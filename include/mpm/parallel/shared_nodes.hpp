#pragma once
/// The nodes that the stencils of several ranks' particles reach.

#include <mpm/parallel/ownership.hpp>

namespace mpm {

/// Of one rank. Where an axis is periodic, a rank may hold a node of the grid more than once (as
/// images), and then shares it with itself.
struct SharedNodes {
  /// Nodes shared with one other rank: positions in `nodes`. Both name them in the same order; a
  /// node of which one of the two holds images is named once for each.
  struct Sharer {
    int rank;
    std::vector<LocalIndex> positions;
  };
  /// This rank's partial sum at position `from` is a term of the sum at position `to`.
  struct OwnTerm {
    LocalIndex to, from;
  };
  std::vector<LocalIndex> nodes;  ///< numbers in the rank's local box, ascending
  std::vector<Sharer> sharers;    ///< ascending rank
  std::vector<OwnTerm> own;       ///< at least one per node: itself

  /// Pairs of a node and a rank to send it to.
  GlobalIndex sent_nodes() const;
};

/// A rank reaches a node if a particle may touch it that is in one of the rank's cells or, after a
/// step, in a cell next to one. Looks at the rank's surroundings only.
///
/// Sums are formed in the order of the ranks, and of the images of one rank by the period in which
/// they lie: lists are ordered so that adding their terms one after the other does that.
template <int Dim>
SharedNodes find_shared_nodes(const Ownership<Dim>& ownership, int support, int rank);

}  // namespace mpm
