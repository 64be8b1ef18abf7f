#include <mpm/core/error.hpp>
#include <mpm/parallel/decomposition.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <numeric>
#include <string>

#include "petsc_check.hpp"
#include <petscdmda.h>

namespace mpm {

namespace {

/// Narrower parts would let a stencil and one step's motion reach past the neighbour; the exchange
/// would still be right, but every rank would talk to many.
constexpr LocalIndex smallest_part = 2;

/// Nodes per part, so that parts weigh about the same and none is narrower than `smallest_part`.
std::vector<PetscInt> weighted_parts(LocalIndex nodes, int parts,
                                     const std::vector<double>& weights)
{
  std::vector<double> sum(nodes + 1, 0.0);
  for (LocalIndex i = 0; i < nodes; ++i) {
    // A bare cell still costs a little; without weights all cells cost the same.
    const double weight = weights.empty() ? 1.0 : (i < LocalIndex(weights.size()) ? weights[i] : 0);
    sum[i + 1] = sum[i] + weight;
  }
  std::vector<PetscInt> counts(parts);
  LocalIndex start = 0;
  for (int p = 0; p < parts; ++p) {
    const double target = sum[nodes] * (p + 1) / parts;
    LocalIndex end = LocalIndex(std::ranges::lower_bound(sum, target) - sum.begin());
    // Of the two cuts around the target, the nearer.
    if (end > start + 1 && target - sum[end - 1] < sum[end] - target) --end;
    end = std::clamp(end, start + smallest_part, nodes - (parts - 1 - p) * smallest_part);
    if (p == parts - 1) end = nodes;
    counts[p] = end - start;
    start = end;
  }
  return counts;
}

template <int Dim>
IndexVec<Dim> chosen_ranks(int ranks, const GridGeometry<Dim>& geometry, IndexVec<Dim> wish,
                           std::optional<int> keep_whole)
{
  // Over all factorisations: few shared nodes, and along `keep_whole` as few cuts as can be.
  IndexVec<Dim> best = IndexVec<Dim>::Zero();
  double best_cost = 0;
  IndexVec<Dim> at;
  const auto visit = [&](auto&& self, int axis, int rest) -> void {
    if (axis == Dim) {
      if (rest != 1) return;
      double cost = 0;
      for (int d = 0; d < Dim; ++d) {
        double face = 1;
        for (int e = 0; e < Dim; ++e)
          if (e != d) face *= geometry.nodes[e];
        cost += (at[d] - 1) * face * (d == keep_whole ? 4.0 : 1.0);
      }
      if (best[0] == 0 || cost < best_cost) best = at, best_cost = cost;
      return;
    }
    for (int p = 1; p <= rest; ++p) {
      if (rest % p != 0 || (wish[axis] > 0 && p != wish[axis])) continue;
      if (geometry.nodes[axis] < p * smallest_part) continue;
      at[axis] = p;
      self(self, axis + 1, rest / p);
    }
  };
  visit(visit, 0, ranks);
  return best;
}

}  // namespace

template <int Dim>
Decomposition<Dim>::Decomposition(MPI_Comm comm, const GridGeometry<Dim>& geometry,
                                  IndexVec<Dim> ranks,
                                  const std::array<std::vector<double>, Dim>& layer_weights,
                                  std::optional<int> keep_whole)
    : comm_(comm), rank_(rank_of(comm)), geometry_(geometry)
{
  const int size = ranks_of(comm);
  ranks_of_axis_ = chosen_ranks<Dim>(size, geometry, ranks, keep_whole);
  if (ranks_of_axis_[0] == 0) {
    std::string wish, nodes;
    for (int d = 0; d < Dim; ++d) {
      wish += (d ? " x " : "") + (ranks[d] ? std::to_string(ranks[d]) : std::string("any"));
      nodes += (d ? " x " : "") + std::to_string(geometry.nodes[d]);
    }
    throw InputError("numerics.ranks: " + std::to_string(size) + " ranks cannot be arranged as " +
                     wish + " on a grid of " + nodes +
                     " nodes (each needs at least 2 nodes per axis). Use fewer ranks or leave "
                     "numerics.ranks out.");
  }

  std::array<std::vector<PetscInt>, 3> parts;
  for (int d = 0; d < Dim; ++d)
    parts[d] = weighted_parts(geometry.nodes[d], ranks_of_axis_[d], layer_weights[d]);
  DM grid;
  if constexpr (Dim == 2)
    petsc_check(DMDACreate2d(comm, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_BOX,
                             geometry.nodes[0], geometry.nodes[1], ranks_of_axis_[0],
                             ranks_of_axis_[1], 1, 0, parts[0].data(), parts[1].data(), &grid));
  else
    petsc_check(DMDACreate3d(comm, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE,
                             DMDA_STENCIL_BOX, geometry.nodes[0], geometry.nodes[1],
                             geometry.nodes[2], ranks_of_axis_[0], ranks_of_axis_[1],
                             ranks_of_axis_[2], 1, 0, parts[0].data(), parts[1].data(),
                             parts[2].data(), &grid));
  petsc_check(DMSetUp(grid));
  const PetscInt* lengths[3] = {nullptr, nullptr, nullptr};
  petsc_check(DMDAGetOwnershipRanges(grid, &lengths[0], &lengths[1], &lengths[2]));
  for (int d = 0; d < Dim; ++d) {
    cuts_[d].assign(ranks_of_axis_[d] + 1, 0);
    for (int p = 0; p < ranks_of_axis_[d]; ++p)
      cuts_[d][p + 1] = cuts_[d][p] + LocalIndex(lengths[d][p]);
  }
  petsc_check(DMDestroy(&grid));
}

template <int Dim>
IndexBox<Dim> Decomposition<Dim>::owned(int rank) const
{
  IndexBox<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    const int part = rank % ranks_of_axis_[d];
    rank /= ranks_of_axis_[d];
    box.lower[d] = cuts_[d][part];
    box.upper[d] = cuts_[d][part + 1];
  }
  return box;
}

template <int Dim>
IndexBox<Dim> Decomposition<Dim>::local(int rank, int support) const
{
  // A particle in cell i has its first node at i (linear) or i - 1 (wider functions) at the lowest,
  // and its last at i + 1 or i + 2; a step moves it by less than a cell.
  const int below = support == 2 ? 0 : 1;
  const int above = support == 2 ? 1 : 2;
  IndexBox<Dim> box = owned(rank);
  for (int d = 0; d < Dim; ++d) {
    box.lower[d] = std::max(0, box.lower[d] - below - 1);
    box.upper[d] = std::min(geometry_.nodes[d], box.upper[d] + above + 1);
  }
  return box;
}

template <int Dim>
int Decomposition<Dim>::owner_of_cell(const IndexVec<Dim>& cell) const
{
  int rank = 0;
  for (int d = Dim; d-- > 0;) {
    const auto after = std::ranges::upper_bound(cuts_[d], cell[d]);
    const int part = std::clamp(int(after - cuts_[d].begin()) - 1, 0, ranks_of_axis_[d] - 1);
    rank = rank * ranks_of_axis_[d] + part;
  }
  return rank;
}

template class Decomposition<2>;
template class Decomposition<3>;

}  // namespace mpm
