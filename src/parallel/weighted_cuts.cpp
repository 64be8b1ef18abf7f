#include <mpm/core/error.hpp>
#include <mpm/parallel/weighted_cuts.hpp>

#include <algorithm>
#include <string>

namespace mpm {

namespace {

/// Narrower parts would let a stencil and one step's motion reach past the neighbour; the exchange
/// would still be right, but every rank would talk to many.
constexpr LocalIndex smallest_part = 2;

/// First node of each part and the end, so that parts weigh about the same and none is narrower
/// than `smallest_part`.
std::vector<LocalIndex> weighted_parts(LocalIndex nodes, int parts,
                                       const std::vector<double>& weights)
{
  std::vector<double> sum(nodes + 1, 0.0);
  for (LocalIndex i = 0; i < nodes; ++i) {
    // A bare cell still costs a little; without weights all cells cost the same.
    const double weight = weights.empty() ? 1.0 : (i < LocalIndex(weights.size()) ? weights[i] : 0);
    sum[i + 1] = sum[i] + weight;
  }
  std::vector<LocalIndex> starts{0};
  LocalIndex start = 0;
  for (int p = 0; p < parts - 1; ++p) {
    const double target = sum[nodes] * (p + 1) / parts;
    LocalIndex end = LocalIndex(std::ranges::lower_bound(sum, target) - sum.begin());
    // Of the two cuts around the target, the nearer.
    if (end > start + 1 && target - sum[end - 1] < sum[end] - target) --end;
    end = std::clamp(end, start + smallest_part, nodes - (parts - 1 - p) * smallest_part);
    starts.push_back(end);
    start = end;
  }
  starts.push_back(nodes);
  return starts;
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
Ownership<Dim> weighted_cuts(const GridGeometry<Dim>& geometry, int ranks,
                             const IndexVec<Dim>& per_axis, const LayerWeights<Dim>& weights,
                             std::optional<int> keep_whole)
{
  const IndexVec<Dim> chosen = chosen_ranks<Dim>(ranks, geometry, per_axis, keep_whole);
  if (chosen[0] == 0) {
    std::string wish, nodes;
    for (int d = 0; d < Dim; ++d) {
      wish += (d ? " x " : "") + (per_axis[d] ? std::to_string(per_axis[d]) : std::string("any"));
      nodes += (d ? " x " : "") + std::to_string(geometry.nodes[d]);
    }
    throw InputError("numerics.ranks: " + std::to_string(ranks) + " ranks cannot be arranged as " +
                     wish + " on a grid of " + nodes +
                     " nodes (each needs at least 2 nodes per axis). Use fewer ranks or leave "
                     "numerics.ranks out.");
  }
  typename Ownership<Dim>::Cuts cuts;
  for (int d = 0; d < Dim; ++d) cuts[d] = weighted_parts(geometry.nodes[d], chosen[d], weights[d]);
  return {geometry, std::move(cuts)};
}

template <int Dim>
bool can_be_cut(const GridGeometry<Dim>& geometry, int ranks, const IndexVec<Dim>& per_axis)
{
  return chosen_ranks<Dim>(ranks, geometry, per_axis, std::nullopt)[0] > 0;
}

template bool can_be_cut<2>(const GridGeometry<2>&, int, const IndexVec<2>&);
template bool can_be_cut<3>(const GridGeometry<3>&, int, const IndexVec<3>&);
template Ownership<2> weighted_cuts<2>(const GridGeometry<2>&, int, const IndexVec<2>&,
                                       const LayerWeights<2>&, std::optional<int>);
template Ownership<3> weighted_cuts<3>(const GridGeometry<3>&, int, const IndexVec<3>&,
                                       const LayerWeights<3>&, std::optional<int>);

}  // namespace mpm
