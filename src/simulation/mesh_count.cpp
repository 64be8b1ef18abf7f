#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/simulation/body_contacts.hpp>
#include <mpm/simulation/mesh_count.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace mpm {

namespace {

/// Whose cells are the locations of the specimen and of its load cell: a material, or the number
/// behind the last one for the load cell.
template <int Dim>
class Lattice {
 public:
  /// `seen`: a part of the lattice; along periodic axes it is seen whole.
  Lattice(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
          const Layout<Dim>& layout, IndexBox<Dim> seen)
      : scene_(scene), layout_(layout), whole_(specimen.whole())
  {
    for (int d = 0; d < Dim; ++d) {
      if (!layout.geometry.periodic[d]) continue;
      seen.lower[d] = whole_.lower[d];
      seen.upper[d] = whole_.upper[d];
    }
    lattice_ = specimen.lattice(intersection(seen, whole_));
  }

  IndexVec<Dim> wrapped(IndexVec<Dim> at) const
  {
    for (int d = 0; d < Dim; ++d)
      if (layout_.geometry.periodic[d]) at[d] = (at[d] + whole_.upper[d]) % whole_.upper[d];
    return at;
  }
  /// -1: nobody's.
  int body_of(const IndexVec<Dim>& location) const
  {
    const IndexVec<Dim> at = wrapped(location);
    if (layout_.load_cell && layout_.load_cell->locations.contains(at))
      return int(scene_.materials.size());
    if (!lattice_.part.contains(at)) return -1;
    const std::int8_t material = lattice_(at);
    return material != lattice_.empty ? material : -1;
  }

 private:
  const scene::Scene& scene_;
  const Layout<Dim>& layout_;
  IndexBox<Dim> whole_;
  micrograph::Lattice<Dim> lattice_;
};

/// A rank with cells at a node, and whether it sees the node at the upper ends of periodic axes.
struct Reacher {
  int rank;
  unsigned image;
  auto operator<=>(const Reacher&) const = default;
};

/// At one node; all images of it are one. Sorted, each once.
template <int Dim>
struct Reachers {
  std::array<Reacher, LocationMesh<Dim>::corners> list;
  int count = 0;
  unsigned cells = 0;  ///< bit c: there is one of which the node is corner c

  /// Of the cells around the corner those of `bodies`, a bit each.
  Reachers(const IndexVec<Dim>& corner, unsigned bodies, const BodyPairs& pairs,
           const Lattice<Dim>& lattice, const Layout<Dim>& layout, const Ownership<Dim>& ownership)
  {
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c) {
      const IndexVec<Dim> cell = corner - LocationMesh<Dim>::offset_of(c);
      const int body = lattice.body_of(cell);
      if (body < 0 || !(bodies & pairs.bit_of(body))) continue;
      cells |= 1u << c;
      unsigned image = 0;
      for (int d = 0; d < Dim; ++d)
        if (layout.geometry.periodic[d] && cell[d] < 0) image |= 1u << d;
      insert({ownership.owner_of_cell(layout.cell_of_location(lattice.wrapped(cell))), image});
    }
  }
  void insert(const Reacher& reacher)
  {
    Reacher* at = std::lower_bound(list.data(), list.data() + count, reacher);
    if (at < list.data() + count && *at == reacher) return;
    std::copy_backward(at, list.data() + count, list.data() + count + 1);
    *at = reacher;
    ++count;
  }
  const Reacher* begin() const { return list.data(); }
  const Reacher* end() const { return list.data() + count; }
};

template <int Dim>
unsigned bodies_around(const IndexVec<Dim>& corner, const BodyPairs& pairs,
                       const Lattice<Dim>& lattice)
{
  unsigned around = 0;
  for (int c = 0; c < LocationMesh<Dim>::corners; ++c)
    if (const int body = lattice.body_of(corner - LocationMesh<Dim>::offset_of(c)); body >= 0)
      around |= pairs.bit_of(body);
  return around;
}

constexpr std::size_t figures = 5;  // summed over parts: nodes, shared, sent, contact cells, hinges

/// Whether the cells at a node are more than one piece, where they hang together by faces.
/// `taken`: bit c for the cell whose corner c it is.
template <int Dim>
bool is_hinge(unsigned taken)
{
  unsigned piece = taken & (0u - taken);  // grows from the first
  for (unsigned before = 0; before != piece;) {
    before = piece;
    for (unsigned c = 0; c < unsigned(LocationMesh<Dim>::corners); ++c)
      for (unsigned d = 0; d < unsigned(Dim); ++d)
        if (piece >> c & 1u) piece |= taken & 1u << (c ^ 1u << d);
  }
  return piece != taken;
}

}  // namespace

template <int Dim>
std::vector<MeshCount> count_mesh(const scene::Scene& scene,
                                  const micrograph::Specimen<Dim>& specimen,
                                  const Layout<Dim>& layout, const Ownership<Dim>& ownership,
                                  MPI_Comm comm)
{
  constexpr GlobalIndex chunk_locations = 1 << 22;  // held at a time
  const auto ranks = std::size_t(ownership.ranks());
  std::vector<double> sums(ranks * figures, 0.0);
  std::vector<std::string> names;
  for (const scene::Material& material : scene.materials) names.push_back(material.name);
  names.emplace_back();  // the load cell
  const BodyPairs bodies = pairs_of_bodies(scene, names);
  std::set<std::array<int, 2>> pairs;
  IndexBox<Dim> box = specimen.whole();
  if (layout.load_cell) {
    box.lower = box.lower.cwiseMin(layout.load_cell->locations.lower);
    box.upper = box.upper.cwiseMax(layout.load_cell->locations.upper);
  }
  for (int d = 0; d < Dim; ++d) box.upper[d] += layout.geometry.periodic[d] ? 0 : 1;
  const auto count_node = [&](const Reachers<Dim>& reachers) {
    if (is_hinge<Dim>(reachers.cells)) ++sums[std::size_t(reachers.begin()->rank) * figures + 4];
    for (const Reacher& reacher : reachers) {
      double* of_rank = &sums[std::size_t(reacher.rank) * figures];
      ++of_rank[0];
      double others = 0;
      for (const Reacher& other : reachers) {
        if (other.rank == reacher.rank) continue;
        ++others;
        pairs.insert({reacher.rank, other.rank});
      }
      of_rank[1] += others > 0;
      of_rank[2] += others;
    }
  };
  micrograph::for_each_chunk(
      micrograph::slab(box, rank_of(comm), ranks_of(comm)), chunk_locations,
      [&](const IndexBox<Dim>& chunk) {
        const auto reach = IndexVec<Dim>::Constant(contact_reach);
        const Lattice<Dim> lattice(scene, specimen, layout,
                                   {chunk.lower - reach, chunk.upper + reach});
        for_each_index(chunk, [&](const IndexVec<Dim>& at) {
          unsigned around = bodies_around(at, bodies, lattice);
          while (around) {
            const unsigned joined = bodies.joined(around, around & (0u - around));
            count_node({at, joined, bodies, lattice, layout, ownership});
            around &= ~joined;
          }
          const int body = lattice.body_of(at);
          const auto is_behind = [&](const IndexVec<Dim>& location) {
            const int other = lattice.body_of(location);
            return other >= 0 && !bodies.are_apart(body, other);
          };
          if (body >= 0 && near_surface<Dim>(at, is_behind))
            ++sums[std::size_t(ownership.owner_of_cell(layout.cell_of_location(at))) * figures + 3];
        });
      });
  sum_over_ranks(comm, std::span(sums));
  std::vector<double> seen;
  for (const auto& [rank, other] : pairs) seen.insert(seen.end(), {double(rank), double(other)});
  const std::vector<double> all = joined_over_ranks(comm, seen);
  for (std::size_t k = 0; k < all.size(); k += 2) pairs.insert({int(all[k]), int(all[k + 1])});
  std::vector<MeshCount> counts(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    const double* of_rank = &sums[r * figures];
    counts[r] = {of_rank[0], of_rank[1], of_rank[2], 0, of_rank[3], of_rank[4]};
  }
  for (const auto& [rank, other] : pairs) ++counts[std::size_t(rank)].sharers;
  return counts;
}

template std::vector<MeshCount> count_mesh(const scene::Scene&, const micrograph::Specimen<2>&,
                                           const Layout<2>&, const Ownership<2>&, MPI_Comm);
template std::vector<MeshCount> count_mesh(const scene::Scene&, const micrograph::Specimen<3>&,
                                           const Layout<3>&, const Ownership<3>&, MPI_Comm);

}  // namespace mpm
