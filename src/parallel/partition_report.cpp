#include <mpm/core/error.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/partition_report.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace mpm {

namespace {

template <int Dim>
WorkMap<Dim> work_of(const GridGeometry<Dim>& geometry, int ranks, const CellVisits<Dim>& particles)
{
  WorkMap<Dim> work(geometry, ranks);
  particles([&](const IndexVec<Dim>& cell) { work.add(cell); });
  return work;
}

std::string line(int ranks, const char* kind, const char* state, const PartitionReport& report)
{
  return fmt::format("{:>6}  {:<5}  {:<22} {:>9.3f} {:>13} {:>10} {:>11}\n", ranks, kind, state,
                     report.imbalance, report.shared_nodes, report.messages, report.bytes);
}

}  // namespace

template <int Dim>
PartitionReport report_on(const Ownership<Dim>& ownership, int support,
                          const CellVisits<Dim>& particles)
{
  PartitionReport report;
  report.imbalance = imbalance_of(loads_of(ownership, particles));
  constexpr GlobalIndex bytes_per_node = sizeof(double) * NodeFields<Dim>::values_per_node;
  for (int rank = 0; rank < ownership.ranks(); ++rank) {
    const SharedNodes shared = find_shared_nodes(ownership, support, rank);
    report.shared_nodes = std::max(report.shared_nodes, GlobalIndex(shared.nodes.size()));
    report.messages = std::max(report.messages, int(shared.sharers.size()));
    report.bytes = std::max(report.bytes, shared.sent_nodes() * bytes_per_node);
  }
  return report;
}

template <int Dim>
Reporter<Dim> grid_reporter(int support)
{
  return [support](const Ownership<Dim>& ownership, const CellVisits<Dim>& cells) {
    return report_on(ownership, support, cells);
  };
}

template <int Dim>
std::string partition_table(const GridGeometry<Dim>& geometry, const std::vector<int>& ranks,
                            const PartitionRules<Dim>& rules, const Reporter<Dim>& report,
                            const CellVisits<Dim>& before, const CellVisits<Dim>& after)
{
  std::string text = fmt::format("{:>6}  {:<5}  {:<22} {:>9} {:>13} {:>10} {:>11}\n", "ranks",
                                 "map", "", "imbalance", "shared nodes", "messages", "bytes");
  for (const int count : ranks)
    for (const PartitionKind kind : {PartitionKind::cuts, PartitionKind::metis}) {
      const bool cuts = kind == PartitionKind::cuts;
      const auto choose = [&](const CellVisits<Dim>& particles, const Ownership<Dim>* earlier) {
        const WorkMap<Dim> work = work_of(geometry, count, particles);
        if (!cuts) return block_ownership<Dim>(geometry, count, work, earlier);
        return weighted_cuts<Dim>(geometry, count, rules.ranks, work.layers(), rules.keep_whole);
      };
      const char* name = cuts ? "cuts" : "METIS";
      try {
        const Ownership<Dim> start = choose(before, nullptr);
        text += line(count, name, "start", report(start, before));
        if (!after) continue;
        text += line(count, name, "compressed, as it was", report(start, after));
        const Ownership<Dim> moved = choose(after, &start);
        text += line(count, name, "compressed, moved", report(moved, after));
      } catch (const InputError& error) {
        text += fmt::format("{:>6}  {:<5}  {}\n", count, name, error.what());
      }
    }
  return text;
}

template PartitionReport report_on(const Ownership<2>&, int, const CellVisits<2>&);
template PartitionReport report_on(const Ownership<3>&, int, const CellVisits<3>&);
template Reporter<2> grid_reporter(int);
template Reporter<3> grid_reporter(int);
template std::string partition_table(const GridGeometry<2>&, const std::vector<int>&,
                                     const PartitionRules<2>&, const Reporter<2>&,
                                     const CellVisits<2>&, const CellVisits<2>&);
template std::string partition_table(const GridGeometry<3>&, const std::vector<int>&,
                                     const PartitionRules<3>&, const Reporter<3>&,
                                     const CellVisits<3>&, const CellVisits<3>&);

}  // namespace mpm
