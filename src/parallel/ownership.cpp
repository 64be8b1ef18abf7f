#include <mpm/core/error.hpp>
#include <mpm/parallel/ownership.hpp>

#include <algorithm>

namespace mpm {

template <int Dim>
Ownership<Dim>::Ownership(const GridGeometry<Dim>& geometry, Cuts cuts)
    : geometry_(geometry), cuts_(std::move(cuts))
{
  bounds_.resize(ranks_per_axis().prod());
  for (int rank = 0; rank < ranks(); ++rank) {
    int rest = rank;
    for (int d = 0; d < Dim; ++d) {
      const int part = rest % ranks_per_axis()[d];
      rest /= ranks_per_axis()[d];
      bounds_[rank].lower[d] = cuts_[d][part];
      bounds_[rank].upper[d] = cuts_[d][part + 1];
    }
  }
}

template <int Dim>
Ownership<Dim>::Ownership(const GridGeometry<Dim>& geometry, LocalIndex edge,
                          std::vector<int> rank_of_block, int ranks)
    : geometry_(geometry),
      edge_(edge),
      blocks_((geometry.nodes.array() + edge - 1) / edge),
      rank_of_block_(std::move(rank_of_block)),
      bounds_(ranks, {geometry.nodes, IndexVec<Dim>::Zero()})
{
  MPM_ASSERT(LocalIndex(rank_of_block_.size()) == blocks_.prod());
  for (LocalIndex block = 0; block < blocks_.prod(); ++block) {
    IndexBox<Dim>& box = bounds_[rank_of_block_[block]];
    LocalIndex rest = block;
    for (int d = 0; d < Dim; ++d) {
      const LocalIndex first = rest % blocks_[d] * edge;
      rest /= blocks_[d];
      box.lower[d] = std::min(box.lower[d], first);
      box.upper[d] = std::max(box.upper[d], std::min(first + edge, geometry.nodes[d]));
    }
  }
}

/// Ranks and edge; then of cuts the number and the cuts of each axis, of blocks the ranks.
template <int Dim>
std::vector<std::int64_t> Ownership<Dim>::packed() const
{
  std::vector<std::int64_t> packed{ranks(), edge_};
  if (!by_cuts()) {
    packed.insert(packed.end(), rank_of_block_.begin(), rank_of_block_.end());
    return packed;
  }
  for (const std::vector<LocalIndex>& cuts : cuts_) {
    packed.push_back(std::int64_t(cuts.size()));
    packed.insert(packed.end(), cuts.begin(), cuts.end());
  }
  return packed;
}

template <int Dim>
Ownership<Dim> Ownership<Dim>::unpacked(const GridGeometry<Dim>& geometry,
                                        std::span<const std::int64_t> packed)
{
  const auto refuse = [] { throw InputError("saved state: its borders are not of this grid."); };
  auto at = packed.begin();
  const auto next = [&] {
    if (at == packed.end()) refuse();
    return *at++;
  };
  const auto ranks = int(next());
  const auto edge = LocalIndex(next());
  if (edge > 0) {
    const IndexVec<Dim> blocks = (geometry.nodes.array() + edge - 1) / edge;
    if (packed.end() - at != blocks.prod()) refuse();
    return {geometry, edge, std::vector<int>(at, packed.end()), ranks};
  }
  Cuts cuts;
  for (int d = 0; d < Dim; ++d) {
    const std::int64_t count = next();
    if (count < 2 || packed.end() - at < count) refuse();
    cuts[std::size_t(d)].assign(at, at + count);
    at += count;
    if (cuts[std::size_t(d)].back() != geometry.nodes[d]) refuse();
  }
  return {geometry, std::move(cuts)};
}

template <int Dim>
IndexVec<Dim> Ownership<Dim>::ranks_per_axis() const
{
  IndexVec<Dim> count = IndexVec<Dim>::Zero();
  if (by_cuts())
    for (int d = 0; d < Dim; ++d) count[d] = LocalIndex(cuts_[d].size()) - 1;
  return count;
}

template <int Dim>
int Ownership<Dim>::owner_of_cell(const IndexVec<Dim>& cell) const
{
  const IndexVec<Dim> inside = geometry_.wrapped(cell);
  int number = 0;  // of the part or block
  for (int d = Dim; d-- > 0;) {
    const LocalIndex at = std::clamp(inside[d], 0, geometry_.nodes[d] - 1);
    if (by_cuts()) {
      const auto after = std::ranges::upper_bound(cuts_[d], at);
      number = number * int(cuts_[d].size() - 1) + int(after - cuts_[d].begin()) - 1;
    } else {
      number = number * blocks_[d] + at / edge_;
    }
  }
  return by_cuts() ? number : rank_of_block_[number];
}

template <int Dim>
IndexBox<Dim> Ownership<Dim>::local(int rank, int support) const
{
  const StencilReach reach(support);
  IndexBox<Dim> box = bounds_[rank];
  for (int d = 0; d < Dim; ++d) {
    box.lower[d] -= reach.below;
    box.upper[d] += reach.above;
    if (geometry_.periodic[d]) continue;
    box.lower[d] = std::max(0, box.lower[d]);
    box.upper[d] = std::min(geometry_.nodes[d], box.upper[d]);
  }
  return box;
}

template class Ownership<2>;
template class Ownership<3>;

}  // namespace mpm
