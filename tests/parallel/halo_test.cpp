#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <thread>

#include <gmock/gmock.h>

namespace mpm {
namespace {

int ranks()
{
  return ranks_of(MPI_COMM_WORLD);
}

/// Ranks in two rows, so that four of them meet in a corner; a row where their number is odd.
template <int Dim>
IndexVec<Dim> two_rows()
{
  IndexVec<Dim> wish = IndexVec<Dim>::Constant(1);
  wish[0] = ranks() % 2 == 0 ? ranks() / 2 : ranks();
  wish[1] = ranks() % 2 == 0 ? 2 : 1;
  return wish;
}

/// A partial sum with a full mantissa: sums in another order would differ in the last bits. Made of
/// integers, so that no fused multiply-add can give it another value at another place.
double partial_value(int rank, GlobalIndex node, int slot)
{
  std::uint64_t bits = std::uint64_t(node) * 64 + std::uint64_t(slot) * 8 + std::uint64_t(rank);
  for (int round = 0; round < 3; ++round) {
    bits = (bits + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    bits ^= bits >> 29;
  }
  return std::ldexp(double(bits >> 11), int(bits % 7) - 50);
}

/// The arrays that sums go to, with every slot filled: what a sum does not concern must stay.
template <int Dim>
struct Slots {
  static constexpr int record = NodeGrid<Dim>::record_width, remap = NodeGrid<Dim>::remap_width;
  static constexpr int first_remap = 1 + record, count = first_remap + remap;

  static double& of(NodeGrid<Dim>& grid, LocalIndex node, int slot)
  {
    if (slot == 0) return grid.mass[node];
    if (slot < first_remap) return grid.momentum_force[std::size_t(node) * record + slot - 1];
    return grid.remapped_momentum[std::size_t(node) * remap + slot - first_remap];
  }
  static int momentum(int d) { return 1 + d; }
  static int force(int d) { return 1 + Dim + d; }
  static int remapped(int d) { return first_remap + d; }
};

/// What each of the four sums concerns.
template <int Dim>
struct NodeSum {
  const char* name;
  void (Halo<Dim>::*run)(NodeGrid<Dim>&);
  std::set<int> slots;
};

template <int Dim>
std::vector<NodeSum<Dim>> node_sums()
{
  std::set<int> mass{0}, momentum, force, remapped;
  for (int d = 0; d < Dim; ++d) {
    momentum.insert(Slots<Dim>::momentum(d));
    force.insert(Slots<Dim>::force(d));
    remapped.insert(Slots<Dim>::remapped(d));
  }
  const auto together = [](std::set<int> a, const std::set<int>& b) {
    a.insert(b.begin(), b.end());
    return a;
  };
  const auto mass_momentum = together(mass, momentum);
  return {{"mass, momentum, force", &Halo<Dim>::sum_mass_momentum_force,
           together(mass_momentum, force)},
          {"mass, momentum", &Halo<Dim>::sum_mass_momentum, mass_momentum},
          {"force", &Halo<Dim>::sum_force, force},
          {"remapped momentum", &Halo<Dim>::sum_remapped_momentum, remapped}};
}

template <int Dim, class Visit>
void for_each_local_node(const IndexBox<Dim>& box, Visit visit)
{
  for (GlobalIndex k = 0; k < box.size(); ++k) {
    GlobalIndex rest = k;
    IndexVec<Dim> node;
    for (int d = 0; d < Dim; ++d) {
      node[d] = box.lower[d] + LocalIndex(rest % box.count()[d]);
      rest /= box.count()[d];
    }
    visit(node);
  }
}

template <int Dim>
class Sharing {
 public:
  Sharing(const IndexVec<Dim>& nodes, const IndexVec<Dim>& wish, int support)
      : support_(support),
        decomposition_(MPI_COMM_WORLD, {Vec<Dim>::Zero(), Vec<Dim>::Ones(), nodes}, wish, {}, {}),
        halo_(decomposition_, support),
        grid_(decomposition_.geometry(), decomposition_.local(rank(), support),
              decomposition_.owned(rank()), 0)
  {
  }

  int rank() const { return decomposition_.rank(); }
  Halo<Dim>& halo() { return halo_; }
  const Decomposition<Dim>& decomposition() const { return decomposition_; }

  std::vector<int> sharers(const IndexVec<Dim>& node) const
  {
    std::vector<int> list;
    for (int rank = 0; rank < decomposition_.ranks(); ++rank)
      if (decomposition_.local(rank, support_).contains(node)) list.push_back(rank);
    return list;
  }

  /// The serial sum, in the order of the ranks: the same bits, so no tolerance.
  void expect_serial_sums(int round)
  {
    using S = Slots<Dim>;
    for (const NodeSum<Dim>& sum : node_sums<Dim>()) {
      for_each_local_node(grid_.local(), [&](const IndexVec<Dim>& node) {
        for (int slot = 0; slot < S::count; ++slot)
          S::of(grid_, grid_.index_of(node), slot) =
              partial_value(rank(), number(node) + round, slot);
      });
      (halo_.*sum.run)(grid_);
      int wrong = 0;
      for_each_local_node(grid_.local(), [&](const IndexVec<Dim>& node) {
        const std::vector<int> together = sharers(node);
        for (int slot = 0; slot < S::count; ++slot) {
          double expected = 0;
          if (sum.slots.contains(slot))
            for (const int sharer : together)
              expected += partial_value(sharer, number(node) + round, slot);
          else
            expected = partial_value(rank(), number(node) + round, slot);
          wrong += S::of(grid_, grid_.index_of(node), slot) != expected;
        }
      });
      EXPECT_EQ(wrong, 0) << "values of the sum of " << sum.name << " in round " << round;
    }
  }

  void expect_only_shared_nodes_are_exchanged()
  {
    std::vector<LocalIndex> shared;
    std::set<int> neighbours;
    GlobalIndex received = 0;
    for_each_local_node(grid_.local(), [&](const IndexVec<Dim>& node) {
      const std::vector<int> together = sharers(node);
      if (together.size() < 2) return;
      shared.push_back(grid_.index_of(node));
      received += GlobalIndex(together.size()) - 1;
      neighbours.insert(together.begin(), together.end());
    });
    neighbours.erase(rank());
    std::ranges::sort(shared);
    EXPECT_EQ(halo_.shared_nodes(), shared);
    EXPECT_EQ(halo_.traffic().shared_nodes, GlobalIndex(shared.size()));
    EXPECT_EQ(halo_.traffic().received_nodes, received);
    EXPECT_EQ(halo_.traffic().neighbours, int(neighbours.size()));
  }

 private:
  GlobalIndex number(const IndexVec<Dim>& node) const
  {
    GlobalIndex number = 0;
    for (int d = Dim; d-- > 0;) number = number * decomposition_.geometry().nodes[d] + node[d];
    return number;
  }

  int support_;
  Decomposition<Dim> decomposition_;
  Halo<Dim> halo_;
  NodeGrid<Dim> grid_;
};

class HaloOfSupport : public testing::TestWithParam<int> {};

TEST_P(HaloOfSupport, SumsEqualTheSerialSumOnEverySharerInAPlane)
{
  Sharing<2> sharing({33, 26}, two_rows<2>(), GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsEqualTheSerialSumOnEverySharerInSpace)
{
  Sharing<3> sharing({14, 13, 9}, two_rows<3>(), GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsHoldWherePartsAreTwoNodesWideAndStencilsReachPastTheNextNeighbour)
{
  Sharing<2> plane({2 * ranks(), 9}, {ranks(), 1}, GetParam());
  plane.expect_serial_sums(0);
  plane.expect_only_shared_nodes_are_exchanged();
  if (ranks() > 2) {
    EXPECT_GE(plane.halo().traffic().neighbours, 2) << "the first rank has one next neighbour";
  }

  Sharing<3> space({5, 2 * ranks(), 6}, {1, ranks(), 1}, GetParam());
  space.expect_serial_sums(0);
  space.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsHoldInPartsTwoNodesWideBothWays)
{
  const IndexVec<2> wish = two_rows<2>();
  Sharing<2> sharing(2 * wish, wish, GetParam());
  sharing.expect_serial_sums(0);
  sharing.expect_only_shared_nodes_are_exchanged();
}

TEST_P(HaloOfSupport, SumsOfManyRoundsDoNotMixWhenRanksAreDelayed)
{
  Sharing<2> sharing({21, 18}, two_rows<2>(), GetParam());
  for (int round = 0; round < 12; ++round) {
    const int delay = (round * 7 + sharing.rank() * 5) % 4;
    std::this_thread::sleep_for(std::chrono::microseconds(400 * delay));
    sharing.expect_serial_sums(round);
  }
}

TEST_P(HaloOfSupport, DiagonalRanksShareTheNodesAroundTheCorner)
{
  if (ranks() % 2 != 0) GTEST_SKIP() << "no corner without two rows of ranks";
  Sharing<2> sharing({40, 40}, two_rows<2>(), GetParam());
  const IndexVec<2> corner = sharing.decomposition().owned(0).upper;
  if (ranks() >= 4) {
    EXPECT_EQ(sharing.sharers(corner).size(), 4u);
  }
  if (ranks() == 2) {
    EXPECT_EQ(sharing.sharers({0, corner[1]}).size(), 2u);
  }
  sharing.expect_serial_sums(0);
}

TEST(Halo, OneRankSharesNothing)
{
  const Decomposition<2> alone(MPI_COMM_SELF, {Vec<2>::Zero(), Vec<2>::Ones(), {12, 9}}, {0, 0}, {},
                               {});
  const Halo<2> halo(alone, 3);
  EXPECT_TRUE(halo.shared_nodes().empty());
  EXPECT_EQ(halo.traffic().neighbours, 0);
  EXPECT_EQ(halo.traffic().received_nodes, 0);
}

INSTANTIATE_TEST_SUITE_P(Supports, HaloOfSupport, testing::Values(2, 3));

}  // namespace
}  // namespace mpm
