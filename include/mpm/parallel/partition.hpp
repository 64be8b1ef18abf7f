#pragma once
/// Which map of owners a run uses: straight cuts or blocks of cells.

#include <mpm/parallel/work_map.hpp>

#include <functional>
#include <optional>

namespace mpm {

enum class PartitionKind {
  automatic,  ///< cuts, unless blocks are better balanced by more than they cost
  cuts,
  metis
};

template <int Dim>
struct PartitionRules {
  PartitionKind kind = PartitionKind::automatic;
  IndexVec<Dim> ranks = IndexVec<Dim>::Zero();  ///< process grid of cuts; 0: chosen
  std::optional<int> keep_whole;                ///< axis to be cut last
};

template <int Dim>
struct Partition {
  Ownership<Dim> ownership;
  std::vector<double> loads;  ///< work of each rank
  double imbalance() const { return imbalance_of(loads); }
};

/// Work of each rank under a map of owners, all ranks' summed.
template <int Dim>
using LoadsUnder = std::function<std::vector<double>(const Ownership<Dim>&)>;

/// Blocks of cells on ranks. With `before`, parts are numbered so that as much work as possible
/// stays where it is.
template <int Dim>
Ownership<Dim> block_ownership(const GridGeometry<Dim>& geometry, int ranks,
                               const WorkMap<Dim>& work, const Ownership<Dim>* before);

/// Collective if `loads_under` is. Throws InputError if there are more ranks than the grid can
/// feed.
template <int Dim>
Partition<Dim> choose_partition(const GridGeometry<Dim>& geometry, int ranks,
                                const PartitionRules<Dim>& rules, const WorkMap<Dim>& work,
                                const LoadsUnder<Dim>& loads_under, const Ownership<Dim>* before);

}  // namespace mpm
