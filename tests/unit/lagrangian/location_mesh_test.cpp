// Meshes of the ranks of a lattice against each other and against the whole lattice.
#include <mpm/lagrangian/location_mesh.hpp>

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace mpm {
namespace {

/// A lattice with holes, shared out at random.
template <int Dim>
struct Case {
  IndexVec<Dim> count, period = IndexVec<Dim>::Zero();
  std::vector<int> rank_of;  ///< x fastest
  std::vector<LocationMesh<Dim>> meshes;

  Case(int ranks, const IndexVec<Dim>& locations, const IndexVec<Dim>& periodic, unsigned seed)
      : count(locations), period(periodic.cwiseProduct(locations))
  {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> rank(-1, ranks - 1);
    rank_of.resize(std::size_t(locations.prod()));
    for (int& r : rank_of) r = rank(random);
    const std::function<int(const IndexVec<Dim>&)> ask = [this](const IndexVec<Dim>& at) {
      return (at.array() < 0).any() || (at.array() >= count.array()).any() ? -1 : rank_at(at);
    };
    for (int r = 0; r < ranks; ++r) {
      std::vector<IndexVec<Dim>> cells;
      for_each([&](const IndexVec<Dim>& at) {
        if (rank_at(at) == r) cells.push_back(at);
      });
      meshes.push_back(make_location_mesh<Dim>(cells, r, ask, period));
    }
  }

  int rank_at(const IndexVec<Dim>& at) const
  {
    LocalIndex k = 0;
    for (int d = Dim; d-- > 0;) k = k * count[d] + at[d];
    return rank_of[std::size_t(k)];
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
  std::vector<LocalIndex> folded(IndexVec<Dim> node) const
  {
    for (int d = 0; d < Dim; ++d)
      if (period[d] > 0) node[d] %= period[d];
    return {node.begin(), node.end()};
  }
};

/// Every cell gives a number to each of its corners; sums over the ranks as Halo makes them.
template <int Dim>
void expect_whole_sums(const Case<Dim>& lattice)
{
  std::map<std::vector<LocalIndex>, double> whole, owners;
  std::vector<std::vector<double>> values;
  for (const LocationMesh<Dim>& mesh : lattice.meshes) {
    auto& value = values.emplace_back(mesh.nodes.size(), 0.0);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (std::size_t k = 0; k < mesh.cells[c].size(); ++k) {
        const double given = double(1 + c) * double(7 + 3 * k);
        value[std::size_t(mesh.cells[c][k])] += given;
        whole[lattice.folded(mesh.nodes[std::size_t(mesh.cells[c][k])])] += given;
      }
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      owners[lattice.folded(mesh.nodes[n])] += mesh.owned[n];
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
      ASSERT_EQ(sum[n], whole.at(lattice.folded(mesh.nodes[n]))) << "rank " << r;
  }
}

TEST(LocationMesh, OfAnyRanksHasTheSumsOfTheWhole)
{
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const int ranks : {1, 2, 3, 5}) {
      expect_whole_sums<2>({ranks, {7, 5}, {0, 0}, seed});
      expect_whole_sums<2>({ranks, {7, 5}, {0, 1}, seed});
      expect_whole_sums<2>({ranks, {4, 3}, {1, 1}, seed});
      expect_whole_sums<3>({ranks, {4, 3, 5}, {1, 0, 1}, seed});
    }
}

TEST(LocationMesh, NumbersTheNodesOfTwoCellsWithACommonEdge)
{
  const std::vector<IndexVec<2>> cells{{0, 0}, {1, 0}};
  const std::function<int(const IndexVec<2>&)> alone = [](const IndexVec<2>& at) {
    return at[1] == 0 && (at[0] == 0 || at[0] == 1) ? 0 : -1;
  };
  const auto mesh = make_location_mesh<2>(cells, 0, alone, IndexVec<2>::Zero());
  EXPECT_EQ(mesh.nodes.size(), 6u);
  EXPECT_EQ(mesh.cells[0], (std::array<LocalIndex, 4>{0, 1, 3, 4}));
  EXPECT_EQ(mesh.cells[1], (std::array<LocalIndex, 4>{1, 2, 4, 5}));
  EXPECT_TRUE(mesh.shared.nodes.empty());
}

}  // namespace
}  // namespace mpm
