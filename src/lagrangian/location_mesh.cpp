#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/lagrangian/location_table.hpp>

#include <algorithm>
#include <bit>
#include <map>
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

/// Of a corner, and which of its nodes: the first body that has it.
template <int Dim>
using NodeKey = std::array<LocalIndex, Dim + 1>;

template <int Dim>
NodeKey<Dim> key_of(const IndexVec<Dim>& at, int body)
{
  NodeKey<Dim> key;
  std::ranges::copy(key_of<Dim>(at), key.begin());
  key[Dim] = body;
  return key;
}

template <int Dim>
IndexVec<Dim> corner_of(const NodeKey<Dim>& key)
{
  IndexVec<Dim> corner;
  for (int d = 0; d < Dim; ++d) corner[d] = key[std::size_t(Dim - 1 - d)];
  return corner;
}

/// A rank with cells at a node, and whether it sees the node at the upper end of an axis (1) that
/// begins again there or elsewhere (0).
template <int Dim>
struct Reacher {
  int rank;
  Key<Dim> image;
  auto operator<=>(const Reacher&) const = default;
};

/// In order, each once.
template <int Dim>
class Reachers {
 public:
  void insert(const Reacher<Dim>& reacher)
  {
    const auto at = std::lower_bound(begin(), end(), reacher);
    if (at != end() && *at == reacher) return;
    const auto place = std::size_t(at - begin());
    std::copy_backward(begin() + place, end(), found_.begin() + count_ + 1);
    found_[place] = reacher;
    ++count_;
  }
  std::size_t size() const { return std::size_t(count_); }
  const Reacher<Dim>* begin() const { return found_.data(); }
  const Reacher<Dim>* end() const { return found_.data() + count_; }

 private:
  std::array<Reacher<Dim>, std::size_t(LocationMesh<Dim>::corners)> found_{};
  int count_ = 0;
};

template <int Dim>
class Lattice {
 public:
  Lattice(const OccupantOf<Dim>& occupant_of, const BodyPairs& pairs, const IndexVec<Dim>& period)
      : occupant_of_(occupant_of), pairs_(pairs), period_(period)
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

  /// The first body that has one node with that of `cell` at a corner of it; 0 where none are
  /// apart.
  int first_body(const IndexVec<Dim>& corner, const IndexVec<Dim>& cell) const
  {
    if (!pairs_.any_apart()) return 0;  // and no cell is looked up
    const int body = occupant_of_(cell).body;
    return std::countr_zero(pairs_.joined(bodies_around(corner), pairs_.bit_of(body)));
  }

  Reachers<Dim> reachers(const IndexVec<Dim>& corner, int first_body) const
  {
    const unsigned joined = pairs_.joined(bodies_around(corner), pairs_.bit_of(first_body));
    Reachers<Dim> found;
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c) {
      const IndexVec<Dim> offset = LocationMesh<Dim>::offset_of(c);
      const IndexVec<Dim> cell = wrapped(corner - offset);
      if (const Occupant occupant = occupant_of_(cell);
          occupant.rank >= 0 && joined & pairs_.bit_of(occupant.body))
        found.insert({occupant.rank, image_of(IndexVec<Dim>(cell + offset))});
    }
    return found;
  }

 private:
  IndexVec<Dim> wrapped(IndexVec<Dim> cell) const
  {
    for (int d = 0; d < Dim; ++d)
      if (period_[d] > 0 && cell[d] < 0) cell[d] += period_[d];
    return cell;
  }
  unsigned bodies_around(const IndexVec<Dim>& corner) const
  {
    if (!pairs_.any_apart()) return pairs_.bit_of(0);
    unsigned around = 0;
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c)
      if (const Occupant occupant =
              occupant_of_(wrapped(folded(corner) - LocationMesh<Dim>::offset_of(c)));
          occupant.body >= 0)
        around |= pairs_.bit_of(occupant.body);
    return around;
  }

  const OccupantOf<Dim>& occupant_of_;
  const BodyPairs& pairs_;
  IndexVec<Dim> period_;
};

/// Numbers of the nodes at corners of the lattice.
template <int Dim>
class NodeNumbers {
 public:
  explicit NodeNumbers(const IndexBox<Dim>& corners) : at_(corners, -1) {}

  /// May come again.
  void add(const IndexVec<Dim>& corner, int first_body)
  {
    LocalIndex& last = at_.at(corner);
    for (LocalIndex n = last; n >= 0; n = before_[std::size_t(n)])
      if (nodes_[std::size_t(n)][Dim] == first_body) return;
    before_.push_back(last);
    last = LocalIndex(nodes_.size());
    nodes_.push_back(key_of<Dim>(corner, first_body));
  }
  /// Once all are there. Returns them in the order of their numbers.
  const std::vector<NodeKey<Dim>>& put_in_order()
  {
    before_ = {};
    std::ranges::sort(nodes_);
    for (std::size_t n = nodes_.size(); n-- > 0;)
      at_.at(corner_of<Dim>(nodes_[n])) = LocalIndex(n);  // the first of a corner stays
    return nodes_;
  }
  /// Of one that was added.
  LocalIndex operator()(const IndexVec<Dim>& corner, int first_body) const
  {
    LocalIndex number = at_(corner);
    while (nodes_[std::size_t(number)][Dim] != first_body) ++number;
    return number;
  }

 private:
  LocationTable<Dim, LocalIndex> at_;
  std::vector<NodeKey<Dim>> nodes_;
  std::vector<LocalIndex> before_;  ///< of each node: the one added before it at its corner, or -1
};

/// One term of the sum at a node, as both ranks see it: the lower rank's image first.
template <int Dim>
struct Term {
  NodeKey<Dim> node;
  Key<Dim> first, second;
  LocalIndex position;

  friend bool operator<(const Term& a, const Term& b)
  {
    return std::tie(a.node, a.first, a.second) < std::tie(b.node, b.first, b.second);
  }
};

/// `nodes`: in the order of their numbers.
template <int Dim>
void share(const Lattice<Dim>& lattice, int rank, const NodeNumbers<Dim>& number,
           const std::vector<NodeKey<Dim>>& nodes, LocationMesh<Dim>& mesh)
{
  std::map<int, std::vector<Term<Dim>>> terms;
  std::vector<std::pair<Term<Dim>, LocalIndex>> own;  // with the node of the image
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const IndexVec<Dim> node = lattice.folded(mesh.nodes[n]);
    const int body = nodes[n][Dim];
    const Reachers<Dim> reachers = lattice.reachers(node, body);
    const Key<Dim> mine = lattice.image_of(mesh.nodes[n]);
    mesh.owned.push_back(reachers.size() == 0 || *reachers.begin() == Reacher<Dim>{rank, mine});
    if (reachers.size() < 2) continue;
    const LocalIndex position = LocalIndex(mesh.shared.nodes.size());
    mesh.shared.nodes.push_back(LocalIndex(n));
    for (const auto& [other, its] : reachers) {
      if (other == rank)
        own.push_back({{key_of<Dim>(node, body), its, mine, position},
                       number(lattice.image_at(node, its), body)});
      else if (other < rank)
        terms[other].push_back({key_of<Dim>(node, body), its, mine, position});
      else
        terms[other].push_back({key_of<Dim>(node, body), mine, its, position});
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
                                     const OccupantOf<Dim>& occupant_of, const BodyPairs& pairs,
                                     const IndexVec<Dim>& period)
{
  const Lattice<Dim> lattice(occupant_of, pairs, period);
  const auto for_each_corner = [&](const IndexVec<Dim>& cell, auto visit) {
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c) {
      const IndexVec<Dim> at = cell + LocationMesh<Dim>::offset_of(c);
      visit(c, at, lattice.first_body(at, cell));
    }
  };
  LocationMesh<Dim> mesh;
  IndexBox<Dim> corners = box_around<Dim>(cells);
  if (!cells.empty()) corners.upper.array() += 1;
  NodeNumbers<Dim> number(corners);
  for (const IndexVec<Dim>& cell : cells)
    for_each_corner(cell, [&](int, const IndexVec<Dim>& at, int body) { number.add(at, body); });
  const std::vector<NodeKey<Dim>>& nodes = number.put_in_order();
  mesh.nodes.reserve(nodes.size());
  for (const NodeKey<Dim>& node : nodes) {
    mesh.nodes.push_back(corner_of<Dim>(node));
    mesh.first_bodies.push_back(char(node[Dim]));
  }
  mesh.cells.reserve(cells.size());
  for (const IndexVec<Dim>& cell : cells) {
    auto& of_cell = mesh.cells.emplace_back();
    for_each_corner(cell, [&](int c, const IndexVec<Dim>& at, int body) {
      of_cell[std::size_t(c)] = number(at, body);
    });
  }
  share<Dim>(lattice, rank, number, nodes, mesh);
  return mesh;
}

template LocationMesh<2> make_location_mesh(std::span<const IndexVec<2>>, int, const OccupantOf<2>&,
                                            const BodyPairs&, const IndexVec<2>&);
template LocationMesh<3> make_location_mesh(std::span<const IndexVec<3>>, int, const OccupantOf<3>&,
                                            const BodyPairs&, const IndexVec<3>&);

}  // namespace mpm
