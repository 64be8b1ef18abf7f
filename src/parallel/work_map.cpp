#include <mpm/parallel/session.hpp>
#include <mpm/parallel/work_map.hpp>

#include <algorithm>
#include <numeric>

namespace mpm {

namespace {

/// One block more or less on a rank is then less than 2 % of its work even if half of the blocks
/// hold nothing.
constexpr GlobalIndex blocks_per_rank = 128;

}  // namespace

template <int Dim>
WorkMap<Dim>::WorkMap(const GridGeometry<Dim>& geometry, int ranks)
{
  const auto blocks_of = [&](LocalIndex edge) -> IndexVec<Dim> {
    return (geometry.nodes.array() + edge - 1) / edge;
  };
  blocks_.cells_per_edge = 1;
  while (blocks_of(2 * blocks_.cells_per_edge).template cast<GlobalIndex>().prod() >=
         blocks_per_rank * ranks)
    blocks_.cells_per_edge *= 2;
  blocks_.blocks = blocks_of(blocks_.cells_per_edge);
  blocks_.work.assign(blocks_.blocks.prod(), 0.0);
  for (int d = 0; d < Dim; ++d) layers_[d].assign(geometry.nodes[d], 0.0);
}

template <int Dim>
void WorkMap<Dim>::add(const IndexVec<Dim>& cell, double work)
{
  LocalIndex block = 0;
  for (int d = Dim; d-- > 0;) {
    const LocalIndex at = std::clamp(cell[d], 0, LocalIndex(layers_[d].size()) - 1);
    layers_[d][at] += work;
    block = block * blocks_.blocks[d] + at / blocks_.cells_per_edge;
  }
  blocks_.work[block] += work;
}

template <int Dim>
void WorkMap<Dim>::sum_over_ranks(MPI_Comm comm)
{
  for (std::vector<double>& layers : layers_) mpm::sum_over_ranks(comm, layers);
  mpm::sum_over_ranks(comm, blocks_.work);
}

template <int Dim>
std::vector<double> loads_of(const Ownership<Dim>& ownership, const CellVisits<Dim>& particles)
{
  std::vector<double> loads(ownership.ranks(), 0.0);
  particles([&](const IndexVec<Dim>& cell) { loads[ownership.owner_of_cell(cell)] += 1; });
  return loads;
}

double imbalance_of(const std::vector<double>& loads)
{
  const double sum = std::accumulate(loads.begin(), loads.end(), 0.0);
  return sum > 0 ? *std::ranges::max_element(loads) * double(loads.size()) / sum : 1.0;
}

template class WorkMap<2>;
template class WorkMap<3>;
template std::vector<double> loads_of(const Ownership<2>&, const CellVisits<2>&);
template std::vector<double> loads_of(const Ownership<3>&, const CellVisits<3>&);

}  // namespace mpm
