#include <mpm/core/error.hpp>
#include <mpm/parallel/decomposition.hpp>
#include <mpm/parallel/session.hpp>

#include <limits>
#include <numeric>

#include "petsc_check.hpp"
#include <fmt/format.h>
#include <petscdmda.h>

namespace mpm {

namespace {

/// Null for blocks.
template <int Dim>
GridHandle make_dmda(MPI_Comm comm, const Ownership<Dim>& wish)
{
  if (!wish.by_cuts()) return {};
  const GridGeometry<Dim>& geometry = wish.geometry();
  const double nodes = geometry.nodes.template cast<double>().prod();
  if (nodes > double(std::numeric_limits<PetscInt>::max()))
    throw InputError(fmt::format(
        "grid.cells: the grid has {:.3g} nodes, more than this PETSc can number for straight cuts. "
        "Set numerics.decomposition: metis, or build with a PETSc of 64-bit indices.",
        nodes));
  const IndexVec<Dim> ranks = wish.ranks_per_axis();
  std::array<std::vector<PetscInt>, Dim> parts;
  DMBoundaryType ends[Dim];
  for (int d = 0; d < Dim; ++d) {
    for (int p = 0; p < ranks[d]; ++p)
      parts[d].push_back(wish.cuts()[d][p + 1] - wish.cuts()[d][p]);
    ends[d] = geometry.periodic[d] ? DM_BOUNDARY_PERIODIC : DM_BOUNDARY_NONE;
  }
  DM grid;
  if constexpr (Dim == 2)
    petsc_check(DMDACreate2d(comm, ends[0], ends[1], DMDA_STENCIL_BOX, geometry.nodes[0],
                             geometry.nodes[1], ranks[0], ranks[1], 1, 0, parts[0].data(),
                             parts[1].data(), &grid));
  else
    petsc_check(DMDACreate3d(comm, ends[0], ends[1], ends[2], DMDA_STENCIL_BOX, geometry.nodes[0],
                             geometry.nodes[1], geometry.nodes[2], ranks[0], ranks[1], ranks[2], 1,
                             0, parts[0].data(), parts[1].data(), parts[2].data(), &grid));
  GridHandle handle(grid, PetscDestroy());
  petsc_check(DMSetUp(grid));
  return handle;
}

/// The cuts as the DMDA has them.
template <int Dim>
Ownership<Dim> ownership_of(DM grid, const GridGeometry<Dim>& geometry)
{
  const PetscInt* lengths[3] = {nullptr, nullptr, nullptr};
  PetscInt ranks[3];
  petsc_check(DMDAGetOwnershipRanges(grid, &lengths[0], &lengths[1], &lengths[2]));
  petsc_check(DMDAGetInfo(grid, nullptr, nullptr, nullptr, nullptr, &ranks[0], &ranks[1], &ranks[2],
                          nullptr, nullptr, nullptr, nullptr, nullptr, nullptr));
  typename Ownership<Dim>::Cuts cuts;
  for (int d = 0; d < Dim; ++d) {
    cuts[d].push_back(0);
    for (int p = 0; p < ranks[d]; ++p)
      cuts[d].push_back(cuts[d].back() + LocalIndex(lengths[d][p]));
  }
  return {geometry, std::move(cuts)};
}

}  // namespace

template <int Dim>
Decomposition<Dim>::Decomposition(MPI_Comm comm, const Ownership<Dim>& ownership)
    : comm_(comm),
      rank_(rank_of(comm)),
      dmda_(make_dmda(comm, ownership)),
      ownership_(dmda_ ? ownership_of(dmda_.get(), ownership.geometry()) : ownership)
{
  MPM_ASSERT(ownership.ranks() == ranks_of(comm));
}

template <int Dim>
Decomposition<Dim>::Decomposition(MPI_Comm comm, const GridGeometry<Dim>& geometry,
                                  const IndexVec<Dim>& ranks,
                                  const LayerWeights<Dim>& layer_weights,
                                  std::optional<int> keep_whole)
    : Decomposition(comm,
                    weighted_cuts<Dim>(geometry, ranks_of(comm), ranks, layer_weights, keep_whole))
{
}

template <int Dim>
std::vector<GlobalIndex> Decomposition<Dim>::numbers_of_owned() const
{
  std::vector<GlobalIndex> numbers;
  if (dmda_) {
    ISLocalToGlobalMapping map;  // the DMDA's own
    petsc_check(DMGetLocalToGlobalMapping(dmda_.get(), &map));
    PetscInt count;
    const PetscInt* list;
    petsc_check(ISLocalToGlobalMappingGetSize(map, &count));
    petsc_check(ISLocalToGlobalMappingGetIndices(map, &list));
    numbers.assign(list, list + count);
    petsc_check(ISLocalToGlobalMappingRestoreIndices(map, &list));
    return numbers;
  }
  GlobalIndex count = 0, end = 0;
  for_each_index(owned(rank_), [&](const IndexVec<Dim>& node) {
    if (owner_of_cell(node) == rank_) ++count;
  });
  MPI_Scan(&count, &end, 1, MPI_INT64_T, MPI_SUM, comm_);
  numbers.resize(count);
  std::iota(numbers.begin(), numbers.end(), end - count);
  return numbers;
}

template <int Dim>
std::vector<char> owned_nodes(const Decomposition<Dim>& decomposition, int support)
{
  const int rank = decomposition.rank();
  const GridGeometry<Dim>& geometry = decomposition.geometry();
  std::vector<char> owned;
  for_each_index(decomposition.local(rank, support), [&](const IndexVec<Dim>& node) {
    owned.push_back(geometry.wrapped(node) == node && decomposition.owner_of_cell(node) == rank);
  });
  return owned;
}

template class Decomposition<2>;
template class Decomposition<3>;
template std::vector<char> owned_nodes(const Decomposition<2>&, int);
template std::vector<char> owned_nodes(const Decomposition<3>&, int);

}  // namespace mpm
