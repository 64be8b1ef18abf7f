#include <mpm/lagrangian/location_mesh.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace mpm {

namespace {

template <int Dim>
using Key = std::array<LocalIndex, Dim>;

/// x fastest.
template <int Dim>
Key<Dim> key_of(const IndexVec<Dim>& at)
{
  Key<Dim> key;
  for (int d = 0; d < Dim; ++d) key[std::size_t(d)] = at[Dim - 1 - d];
  return key;
}

/// A rank with cells at a node, and whether it sees the node at the upper end of an axis (1) that
/// begins again there or elsewhere (0).
template <int Dim>
struct Reacher {
  int rank;
  Key<Dim> image;
  auto operator<=>(const Reacher&) const = default;
};

template <int Dim>
class Lattice {
 public:
  Lattice(const std::function<int(const IndexVec<Dim>&)>& rank_of, const IndexVec<Dim>& period)
      : rank_of_(rank_of), period_(period)
  {
  }

  /// The corner that stands for all images.
  IndexVec<Dim> folded(IndexVec<Dim> corner) const
  {
    for (int d = 0; d < Dim; ++d)
      if (period_[d] > 0 && corner[d] == period_[d]) corner[d] = 0;
    return corner;
  }
  Key<Dim> image_of(const IndexVec<Dim>& corner) const
  {
    return key_of<Dim>((corner - folded(corner)).cwiseMin(1));
  }
  IndexVec<Dim> image_at(const IndexVec<Dim>& corner, const Key<Dim>& image) const
  {
    IndexVec<Dim> at = corner;
    for (int d = 0; d < Dim; ++d) at[d] += period_[d] * image[std::size_t(Dim - 1 - d)];
    return at;
  }

  std::set<Reacher<Dim>> reachers(const IndexVec<Dim>& corner) const
  {
    std::set<Reacher<Dim>> found;
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c) {
      const IndexVec<Dim> offset = LocationMesh<Dim>::offset_of(c);
      IndexVec<Dim> cell = corner - offset;
      for (int d = 0; d < Dim; ++d)
        if (period_[d] > 0 && cell[d] < 0) cell[d] += period_[d];
      if (const int rank = rank_of_(cell); rank >= 0)
        found.insert({rank, image_of(IndexVec<Dim>(cell + offset))});
    }
    return found;
  }

 private:
  const std::function<int(const IndexVec<Dim>&)>& rank_of_;
  IndexVec<Dim> period_;
};

/// One term of the sum at a node, as both ranks see it: the lower rank's image first.
template <int Dim>
struct Term {
  Key<Dim> node, first, second;
  LocalIndex position;

  friend bool operator<(const Term& a, const Term& b)
  {
    return std::tie(a.node, a.first, a.second) < std::tie(b.node, b.first, b.second);
  }
};

template <int Dim>
void share(const Lattice<Dim>& lattice, int rank, const std::map<Key<Dim>, LocalIndex>& number,
           LocationMesh<Dim>& mesh)
{
  std::map<int, std::vector<Term<Dim>>> terms;
  std::vector<std::pair<Term<Dim>, LocalIndex>> own;  // with the node of the image
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const IndexVec<Dim> node = lattice.folded(mesh.nodes[n]);
    const auto reachers = lattice.reachers(node);
    const Key<Dim> mine = lattice.image_of(mesh.nodes[n]);
    mesh.owned.push_back(reachers.empty() || *reachers.begin() == Reacher<Dim>{rank, mine});
    if (reachers.size() < 2) continue;
    const LocalIndex position = LocalIndex(mesh.shared.nodes.size());
    mesh.shared.nodes.push_back(LocalIndex(n));
    for (const auto& [other, its] : reachers) {
      if (other == rank)
        own.push_back({{key_of<Dim>(node), its, mine, position},
                       number.at(key_of<Dim>(lattice.image_at(node, its)))});
      else if (other < rank)
        terms[other].push_back({key_of<Dim>(node), its, mine, position});
      else
        terms[other].push_back({key_of<Dim>(node), mine, its, position});
    }
  }
  std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [term, image] : own) {
    const auto from = std::ranges::lower_bound(mesh.shared.nodes, image);
    mesh.shared.own.push_back({term.position, LocalIndex(from - mesh.shared.nodes.begin())});
  }
  for (auto& [other, list] : terms) {
    std::sort(list.begin(), list.end());
    SharedNodes::Sharer& sharer = mesh.shared.sharers.emplace_back();
    sharer.rank = other;
    for (const Term<Dim>& term : list) sharer.positions.push_back(term.position);
  }
}

}  // namespace

template <int Dim>
LocationMesh<Dim> make_location_mesh(std::span<const IndexVec<Dim>> cells, int rank,
                                     const std::function<int(const IndexVec<Dim>&)>& rank_of,
                                     const IndexVec<Dim>& period)
{
  LocationMesh<Dim> mesh;
  std::map<Key<Dim>, LocalIndex> number;
  for (const IndexVec<Dim>& cell : cells)
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c)
      number[key_of<Dim>(cell + LocationMesh<Dim>::offset_of(c))] = 0;
  for (auto& [key, node] : number) {
    node = LocalIndex(mesh.nodes.size());
    IndexVec<Dim> at;
    for (int d = 0; d < Dim; ++d) at[d] = key[std::size_t(Dim - 1 - d)];
    mesh.nodes.push_back(at);
  }
  for (const IndexVec<Dim>& cell : cells) {
    auto& corners = mesh.cells.emplace_back();
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c)
      corners[std::size_t(c)] = number.at(key_of<Dim>(cell + LocationMesh<Dim>::offset_of(c)));
  }
  share<Dim>(Lattice<Dim>(rank_of, period), rank, number, mesh);
  return mesh;
}

template LocationMesh<2> make_location_mesh(std::span<const IndexVec<2>>, int,
                                            const std::function<int(const IndexVec<2>&)>&,
                                            const IndexVec<2>&);
template LocationMesh<3> make_location_mesh(std::span<const IndexVec<3>>, int,
                                            const std::function<int(const IndexVec<3>&)>&,
                                            const IndexVec<3>&);

}  // namespace mpm
