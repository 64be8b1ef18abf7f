#include <mpm/parallel/shared_nodes.hpp>

#include <algorithm>
#include <map>

namespace mpm {

namespace {

/// Owners of the cells around a rank's local box.
template <int Dim>
class Surroundings {
 public:
  Surroundings(const Ownership<Dim>& ownership, const IndexBox<Dim>& nodes, StencilReach reach)
      : reach_(reach), stamps_(ownership.ranks(), -1)
  {
    for (int d = 0; d < Dim; ++d) {
      cells_.lower[d] = std::max(0, nodes.lower[d] - reach.above);
      cells_.upper[d] = std::min(ownership.geometry().nodes[d], nodes.upper[d] + reach.below);
    }
    for_each_index(cells_, [&](const IndexVec<Dim>& cell) {
      owners_.push_back(ownership.owner_of_cell(cell));
    });
    lowest_ = highest_ = owners_;
    spread(lowest_, [](int a, int b) { return std::min(a, b); });
    spread(highest_, [](int a, int b) { return std::max(a, b); });
  }

  /// Ranks that reach a node, in no order; empty if it is one rank only.
  const std::vector<int>& sharers(const IndexVec<Dim>& node)
  {
    found_.clear();
    const LocalIndex at = number_in(cells_, node);
    if (lowest_[at] == highest_[at]) return found_;
    ++stamp_;
    for_each_index(window(node), [&](const IndexVec<Dim>& cell) {
      const int owner = owners_[number_in(cells_, cell)];
      if (stamps_[owner] == stamp_) return;
      stamps_[owner] = stamp_;
      found_.push_back(owner);
    });
    return found_;
  }

 private:
  /// Cells from which a node is reached.
  IndexBox<Dim> window(const IndexVec<Dim>& node) const
  {
    const IndexBox<Dim> all{(node.array() - reach_.above).matrix(),
                            (node.array() + reach_.below + 1).matrix()};
    return intersection(all, cells_);
  }

  /// Lowest or highest owner in the window of each node, axis by axis.
  template <class Choose>
  void spread(std::vector<int>& owners, Choose choose) const
  {
    const IndexVec<Dim> count = cells_.count();
    LocalIndex stride = 1;
    for (int d = 0; d < Dim; ++d) {
      const std::vector<int> source = owners;
      for (LocalIndex k = 0; k < LocalIndex(source.size()); ++k) {
        const LocalIndex at = k / stride % count[d];
        const LocalIndex from = std::max(at - reach_.above, 0);
        const LocalIndex to = std::min(at + reach_.below, count[d] - 1);
        for (LocalIndex i = from; i <= to; ++i)
          owners[k] = choose(owners[k], source[k + (i - at) * stride]);
      }
      stride *= count[d];
    }
  }

  StencilReach reach_;
  IndexBox<Dim> cells_;
  std::vector<int> owners_, lowest_, highest_, found_;
  std::vector<GlobalIndex> stamps_;
  GlobalIndex stamp_ = 0;
};

}  // namespace

GlobalIndex SharedNodes::sent_nodes() const
{
  GlobalIndex count = 0;
  for (const Sharer& sharer : sharers) count += GlobalIndex(sharer.positions.size());
  return count;
}

template <int Dim>
SharedNodes find_shared_nodes(const Ownership<Dim>& ownership, int support, int rank)
{
  SharedNodes shared;
  const IndexBox<Dim> local = ownership.local(rank, support);
  Surroundings<Dim> surroundings(ownership, local, StencilReach(support));
  std::map<int, std::vector<LocalIndex>> positions;
  LocalIndex number = 0;
  for_each_index(local, [&](const IndexVec<Dim>& node) {
    const std::vector<int>& ranks = surroundings.sharers(node);
    if (std::ranges::find(ranks, rank) != ranks.end()) {
      for (const int other : ranks)
        if (other != rank) positions[other].push_back(LocalIndex(shared.nodes.size()));
      shared.nodes.push_back(number);
    }
    ++number;
  });
  for (auto& [other, list] : positions) shared.sharers.push_back({other, std::move(list)});
  return shared;
}

template SharedNodes find_shared_nodes(const Ownership<2>&, int, int);
template SharedNodes find_shared_nodes(const Ownership<3>&, int, int);

}  // namespace mpm
