// Meshes of the ranks of a lattice against each other and against the whole lattice.
#include <mpm/lagrangian/location_mesh.hpp>

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// A lattice with holes and of three bodies, shared out at random.
template <int Dim>
struct Case {
  IndexVec<Dim> count, period = IndexVec<Dim>::Zero();
  std::vector<int> rank_of, body_of;  ///< x fastest
  BodyPairs pairs{3};
  std::vector<LocationMesh<Dim>> meshes;

  /// `apart`: bodies 0 and 1, and 2 holds on to both.
  Case(int ranks, const IndexVec<Dim>& locations, const IndexVec<Dim>& periodic, unsigned seed,
       bool apart)
      : count(locations), period(periodic.cwiseProduct(locations))
  {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> rank(-1, ranks - 1);
    rank_of.resize(std::size_t(locations.prod()));
    for (int& r : rank_of) r = rank(random);
    body_of.resize(rank_of.size());
    for (int& body : body_of) body = std::uniform_int_distribution<int>(0, 9)(random) % 3;
    if (apart) pairs.add(0, 1, 0);
    const OccupantOf<Dim> ask = [this](const IndexVec<Dim>& at) { return occupant(at); };
    for (int r = 0; r < ranks; ++r) {
      std::vector<IndexVec<Dim>> cells;
      for_each([&](const IndexVec<Dim>& at) {
        if (rank_at(at) == r) cells.push_back(at);
      });
      meshes.push_back(make_location_mesh<Dim>(cells, r, ask, pairs, period));
    }
  }

  std::size_t number_of(const IndexVec<Dim>& at) const
  {
    LocalIndex k = 0;
    for (int d = Dim; d-- > 0;) k = k * count[d] + at[d];
    return std::size_t(k);
  }
  int rank_at(const IndexVec<Dim>& at) const { return rank_of[number_of(at)]; }
  Occupant occupant(const IndexVec<Dim>& at) const
  {
    if ((at.array() < 0).any() || (at.array() >= count.array()).any() || rank_at(at) < 0) return {};
    return {rank_at(at), body_of[number_of(at)]};
  }
  /// Whether 0 and 1 are two nodes at a corner: body 2 is not there to hold both.
  bool splits(const IndexVec<Dim>& corner) const
  {
    for (int c = 0; c < LocationMesh<Dim>::corners; ++c) {
      IndexVec<Dim> cell = corner - LocationMesh<Dim>::offset_of(c);
      for (int d = 0; d < Dim; ++d)
        if (period[d] > 0) cell[d] = (cell[d] + period[d]) % period[d];
      if (occupant(cell).body == 2) return false;
    }
    return pairs.any_apart();
  }
  template <class Visit>
  void for_each(Visit visit) const
  {
    for (LocalIndex k = 0; k < count.prod(); ++k) {
      IndexVec<Dim> at;
      for (LocalIndex rest = k, d = 0; d < Dim; rest /= count[d], ++d) at[d] = rest % count[d];
      visit(at);
    }
  }
  /// Of a corner of a cell of that body.
  std::vector<LocalIndex> folded(IndexVec<Dim> node, int body) const
  {
    for (int d = 0; d < Dim; ++d)
      if (period[d] > 0) node[d] %= period[d];
    std::vector<LocalIndex> key(node.begin(), node.end());
    key.push_back(splits(node) ? body : -1);
    return key;
  }
};

/// Every cell gives a number to each of its corners; sums over the ranks as Halo makes them.
template <int Dim>
void expect_whole_sums(const Case<Dim>& lattice)
{
  std::map<std::vector<LocalIndex>, double> whole, owners;
  std::vector<std::vector<double>> values;
  std::vector<std::vector<int>> bodies;  // of the nodes
  for (int rank = 0; rank < int(lattice.meshes.size()); ++rank) {
    const LocationMesh<Dim>& mesh = lattice.meshes[std::size_t(rank)];
    auto& body = bodies.emplace_back(mesh.nodes.size(), -1);
    std::size_t cell = 0;
    lattice.for_each([&](const IndexVec<Dim>& at) {
      if (lattice.rank_at(at) != rank) return;
      for (const LocalIndex node : mesh.cells[cell]) {
        int& of_node = body[std::size_t(node)];
        const int own = lattice.body_of[lattice.number_of(at)];
        // Who has a node has it alone, or body 2 holds on.
        if (of_node >= 0 && lattice.splits(mesh.nodes[std::size_t(node)])) {
          ASSERT_EQ(of_node, own);
        }
        of_node = own;
      }
      ++cell;
    });
    auto& value = values.emplace_back(mesh.nodes.size(), 0.0);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (std::size_t k = 0; k < mesh.cells[c].size(); ++k) {
        const double given = double(1 + c) * double(7 + 3 * k);
        value[std::size_t(mesh.cells[c][k])] += given;
        const auto node = std::size_t(mesh.cells[c][k]);
        whole[lattice.folded(mesh.nodes[node], body[node])] += given;
      }
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      owners[lattice.folded(mesh.nodes[n], body[n])] += mesh.owned[n];
  }
  for (const auto& [node, count] : owners) ASSERT_EQ(count, 1);
  for (std::size_t r = 0; r < values.size(); ++r) {
    const LocationMesh<Dim>& mesh = lattice.meshes[r];
    std::vector<double> total(mesh.shared.nodes.size(), 0.0);
    for (const auto& [to, from] : mesh.shared.own)
      total[std::size_t(to)] += values[r][std::size_t(mesh.shared.nodes[std::size_t(from)])];
    for (const SharedNodes::Sharer& sharer : mesh.shared.sharers) {
      const SharedNodes& its = lattice.meshes[std::size_t(sharer.rank)].shared;
      const auto back = std::ranges::find(its.sharers, int(r), &SharedNodes::Sharer::rank);
      ASSERT_NE(back, its.sharers.end());
      ASSERT_EQ(back->positions.size(), sharer.positions.size());
      for (std::size_t k = 0; k < sharer.positions.size(); ++k)
        total[std::size_t(sharer.positions[k])] +=
            values[std::size_t(sharer.rank)]
                  [std::size_t(its.nodes[std::size_t(back->positions[k])])];
    }
    std::vector<double> sum = values[r];
    for (std::size_t k = 0; k < total.size(); ++k)
      sum[std::size_t(mesh.shared.nodes[k])] = total[k];
    for (std::size_t n = 0; n < sum.size(); ++n)
      ASSERT_EQ(sum[n], whole.at(lattice.folded(mesh.nodes[n], bodies[r][n]))) << "rank " << r;
  }
}

TEST(LocationMesh, OfAnyRanksHasTheSumsOfTheWhole)
{
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const int ranks : {1, 2, 3, 5})
      for (const bool apart : {false, true}) {
        expect_whole_sums<2>({ranks, {7, 5}, {0, 0}, seed, apart});
        expect_whole_sums<2>({ranks, {7, 5}, {0, 1}, seed, apart});
        expect_whole_sums<2>({ranks, {4, 3}, {1, 1}, seed, apart});
        expect_whole_sums<3>({ranks, {4, 3, 5}, {1, 0, 1}, seed, apart});
      }
}

TEST(LocationMesh, NumbersTheNodesOfTwoCellsWithACommonEdge)
{
  const std::vector<IndexVec<2>> cells{{0, 0}, {1, 0}};
  const OccupantOf<2> alone = [](const IndexVec<2>& at) {
    return at[1] == 0 && (at[0] == 0 || at[0] == 1) ? Occupant{0, at[0]} : Occupant{};
  };
  BodyPairs pairs(2);
  const auto mesh = make_location_mesh<2>(cells, 0, alone, pairs, IndexVec<2>::Zero());
  EXPECT_EQ(mesh.nodes.size(), 6u);
  EXPECT_EQ(mesh.cells[0], (std::array<LocalIndex, 4>{0, 1, 3, 4}));
  EXPECT_EQ(mesh.cells[1], (std::array<LocalIndex, 4>{1, 2, 4, 5}));
  EXPECT_TRUE(mesh.shared.nodes.empty());
  pairs.add(0, 1, 0);
  const auto apart = make_location_mesh<2>(cells, 0, alone, pairs, IndexVec<2>::Zero());
  EXPECT_EQ(apart.nodes.size(), 8u);
  EXPECT_EQ(apart.cells[0], (std::array<LocalIndex, 4>{0, 1, 4, 5}));
  EXPECT_EQ(apart.cells[1], (std::array<LocalIndex, 4>{2, 3, 6, 7}));
}

}  // namespace
}  // namespace mpm
