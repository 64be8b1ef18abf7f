#pragma once
/// What a map of owners would cost, for any number of ranks and without running on them.

#include <mpm/parallel/partition.hpp>

#include <string>

namespace mpm {

struct PartitionReport {
  double imbalance = 1;          ///< particles of the fullest rank over the mean
  GlobalIndex shared_nodes = 0;  ///< of the rank that shares most
  int messages = 0;              ///< per exchange, of the rank with most neighbours
  GlobalIndex bytes = 0;         ///< per exchange of mass, momentum and force, of the busiest
};

/// Of a grid and stencils of so many nodes per axis. Looks at every rank in turn.
template <int Dim>
PartitionReport report_on(const Ownership<Dim>& ownership, int support,
                          const CellVisits<Dim>& particles);

/// What a partition costs particles that are in these cells.
template <int Dim>
using Reporter =
    std::function<PartitionReport(const Ownership<Dim>& ownership, const CellVisits<Dim>& cells)>;

/// `report_on` with stencils of so many nodes per axis.
template <int Dim>
Reporter<Dim> grid_reporter(int support);

/// Reports on cuts and on blocks, before and, if any, after a change of the particles' places: with
/// the borders left as they were, and moved. One line each, under a header.
template <int Dim>
std::string partition_table(const GridGeometry<Dim>& geometry, const std::vector<int>& ranks,
                            const PartitionRules<Dim>& rules, const Reporter<Dim>& report,
                            const CellVisits<Dim>& before, const CellVisits<Dim>& after);

}  // namespace mpm
