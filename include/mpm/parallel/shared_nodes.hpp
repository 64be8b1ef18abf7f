#pragma once
/// The nodes that the stencils of several ranks' particles reach.

#include <mpm/parallel/ownership.hpp>

namespace mpm {

/// Of one rank.
struct SharedNodes {
  /// Nodes shared with one other rank: positions in `nodes`. Both name them in the same order.
  struct Sharer {
    int rank;
    std::vector<LocalIndex> positions;
  };
  std::vector<LocalIndex> nodes;  ///< numbers in the rank's local box, ascending
  std::vector<Sharer> sharers;    ///< ascending rank

  /// Pairs of a node and a rank to send it to.
  GlobalIndex sent_nodes() const;
};

/// A rank reaches a node if a particle may touch it that is in one of the rank's cells or, after a
/// step, in a cell next to one. Looks at the rank's surroundings only.
template <int Dim>
SharedNodes find_shared_nodes(const Ownership<Dim>& ownership, int support, int rank);

}  // namespace mpm
