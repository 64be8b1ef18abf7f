#include <mpm/core/error.hpp>
#include <mpm/parallel/shared_nodes.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace mpm {

namespace {

/// A rank that reaches a node, and by how many periods the cells from which it does lie away from
/// its own: with those it sees an image of the node.
template <int Dim>
struct Reacher {
  int rank;
  IndexVec<Dim> periods;

  static constexpr int bits = 4, half = 1 << (bits - 1);  // of periods, on each axis
  std::int64_t key() const
  {
    std::int64_t key = rank;
    for (int d = 0; d < Dim; ++d) {
      MPM_ASSERT(periods[d] >= -half && periods[d] < half);
      key = (key << bits) + periods[d] + half;
    }
    return key;
  }
  static Reacher of(std::int64_t key)
  {
    Reacher reacher;
    for (int d = Dim; d-- > 0; key >>= bits)
      reacher.periods[d] = LocalIndex(key & ((1 << bits) - 1)) - half;
    reacher.rank = int(key);
    return reacher;
  }
};

/// Owners of the cells around a rank's local box.
template <int Dim>
class Surroundings {
 public:
  Surroundings(const Ownership<Dim>& ownership, const IndexBox<Dim>& nodes, StencilReach reach)
      : reach_(reach)
  {
    const GridGeometry<Dim>& geometry = ownership.geometry();
    for (int d = 0; d < Dim; ++d) {
      cells_.lower[d] = nodes.lower[d] - reach.above;
      cells_.upper[d] = nodes.upper[d] + reach.below;
      if (geometry.periodic[d]) continue;
      cells_.lower[d] = std::max(0, cells_.lower[d]);
      cells_.upper[d] = std::min(geometry.nodes[d], cells_.upper[d]);
    }
    for_each_index(cells_, [&](const IndexVec<Dim>& cell) {
      owners_.push_back(
          Reacher<Dim>{ownership.owner_of_cell(cell), geometry.periods_of(cell)}.key());
    });
    lowest_ = highest_ = owners_;
    spread(lowest_, [](std::int64_t a, std::int64_t b) { return std::min(a, b); });
    spread(highest_, [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
  }

  /// Keys of those that reach a node, in no order; empty if it is one rank once.
  const std::vector<std::int64_t>& reachers(const IndexVec<Dim>& node)
  {
    found_.clear();
    const LocalIndex at = number_in(cells_, node);
    if (lowest_[at] == highest_[at]) return found_;
    for_each_index(window(node), [&](const IndexVec<Dim>& cell) {
      const std::int64_t key = owners_[number_in(cells_, cell)];
      if (std::ranges::find(found_, key) == found_.end()) found_.push_back(key);
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
  void spread(std::vector<std::int64_t>& owners, Choose choose) const
  {
    const IndexVec<Dim> count = cells_.count();
    LocalIndex stride = 1;
    for (int d = 0; d < Dim; ++d) {
      const std::vector<std::int64_t> source = owners;
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
  std::vector<std::int64_t> owners_, lowest_, highest_, found_;
};

/// One term of the sum at a node, as both ranks see it: the node of the grid, and in which period
/// each of them holds it, the lower rank first.
template <int Dim>
struct Term {
  GlobalIndex node;
  std::array<LocalIndex, Dim> first, second;
  LocalIndex position;  ///< of the node in this rank's list

  friend bool operator<(const Term& a, const Term& b)
  {
    return std::tie(a.node, a.first, a.second) < std::tie(b.node, b.first, b.second);
  }
};

template <int Dim>
std::array<LocalIndex, Dim> as_array(const IndexVec<Dim>& v)
{
  std::array<LocalIndex, Dim> values;
  for (int d = 0; d < Dim; ++d) values[d] = v[d];
  return values;
}

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
  const GridGeometry<Dim>& geometry = ownership.geometry();
  const IndexBox<Dim> local = ownership.local(rank, support);
  const IndexBox<Dim> all{IndexVec<Dim>::Zero(), geometry.nodes};
  Surroundings<Dim> surroundings(ownership, local, StencilReach(support));
  const std::int64_t myself = Reacher<Dim>{rank, IndexVec<Dim>::Zero()}.key();
  std::map<int, std::vector<Term<Dim>>> terms;
  std::vector<std::pair<Term<Dim>, IndexVec<Dim>>> own;  // with the index of the image
  LocalIndex number = 0;
  for_each_index(local, [&](const IndexVec<Dim>& node) {
    const std::vector<std::int64_t>& reachers = surroundings.reachers(node);
    if (std::ranges::find(reachers, myself) != reachers.end()) {
      const IndexVec<Dim> here = geometry.periods_of(node), in_grid = geometry.wrapped(node);
      GlobalIndex name = 0;
      for (int d = Dim; d-- > 0;) name = name * all.upper[d] + in_grid[d];
      const LocalIndex position = LocalIndex(shared.nodes.size());
      for (const std::int64_t key : reachers) {
        const auto [other, periods] = Reacher<Dim>::of(key);
        const auto mine = as_array<Dim>(here), its = as_array<Dim>(here - periods);
        if (other == rank)
          own.push_back(
              {{position, its, {}, position}, node - periods.cwiseProduct(geometry.nodes)});
        else if (other < rank)
          terms[other].push_back({name, its, mine, position});
        else
          terms[other].push_back({name, mine, its, position});
      }
      shared.nodes.push_back(number);
    }
    ++number;
  });
  std::ranges::sort(own, {},
                    [](const auto& pair) { return std::tie(pair.first.node, pair.first.first); });
  for (const auto& [term, image] : own) {
    const LocalIndex at = number_in(local, image);
    const auto from = std::ranges::lower_bound(shared.nodes, at);
    MPM_ASSERT(from != shared.nodes.end() && *from == at);
    shared.own.push_back({term.position, LocalIndex(from - shared.nodes.begin())});
  }
  for (auto& [other, list] : terms) {
    std::sort(list.begin(), list.end());
    SharedNodes::Sharer& sharer = shared.sharers.emplace_back(SharedNodes::Sharer{other, {}});
    for (const Term<Dim>& term : list) sharer.positions.push_back(term.position);
  }
  return shared;
}

template SharedNodes find_shared_nodes(const Ownership<2>&, int, int);
template SharedNodes find_shared_nodes(const Ownership<3>&, int, int);

}  // namespace mpm
