#pragma once
/// All particles go to the ranks that own their cells, wherever those are.

#include <mpm/materials/body.hpp>
#include <mpm/parallel/decomposition.hpp>

#include <vector>

namespace mpm {

struct Redistributed {
  GlobalIndex sent = 0;             ///< particles, by this rank
  std::vector<LocalIndex> arrived;  ///< per body, at the end of its store in the order of the ranks
};

/// After the map of owners has changed. Collective.
///
/// Messages go to those that get particles only (nonblocking consensus; Hoefler, Siebert &
/// Lumsdaine 2010, PPoPP): synchronous sends, probe and receive, and once one's own sends have
/// arrived a nonblocking barrier, whose end means that nothing is under way any more.
template <int Dim>
Redistributed redistribute(const Decomposition<Dim>& decomposition, std::vector<Body<Dim>>& bodies);

}  // namespace mpm
