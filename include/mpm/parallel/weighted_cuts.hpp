#pragma once
/// Straight cuts through the grid, so that every part weighs about the same.

#include <mpm/parallel/ownership.hpp>

#include <optional>

namespace mpm {

/// Per axis, the work in each cell layer; an empty list: equal in all.
template <int Dim>
using LayerWeights = std::array<std::vector<double>, Dim>;

/// `per_axis`: 0 in an axis lets the choice to us: cuts across `keep_whole` come last, because a
/// piston along that axis empties part of it. Throws InputError if there are more ranks than the
/// grid can feed.
template <int Dim>
Ownership<Dim> weighted_cuts(const GridGeometry<Dim>& geometry, int ranks,
                             const IndexVec<Dim>& per_axis, const LayerWeights<Dim>& weights,
                             std::optional<int> keep_whole);

/// Whether there is a way to arrange so many ranks.
template <int Dim>
bool can_be_cut(const GridGeometry<Dim>& geometry, int ranks, const IndexVec<Dim>& per_axis);

}  // namespace mpm
