#include <mpm/core/error.hpp>
#include <mpm/parallel/decomposition.hpp>
#include <mpm/parallel/session.hpp>

#include "petsc_check.hpp"
#include <petscdmda.h>

namespace mpm {

namespace {

/// The cuts as a DMDA has them.
template <int Dim>
Ownership<Dim> through_dmda(MPI_Comm comm, const Ownership<Dim>& wish)
{
  const GridGeometry<Dim>& geometry = wish.geometry();
  const IndexVec<Dim> ranks = wish.ranks_per_axis();
  std::array<std::vector<PetscInt>, 3> parts;
  for (int d = 0; d < Dim; ++d)
    for (int p = 0; p < ranks[d]; ++p)
      parts[d].push_back(wish.cuts()[d][p + 1] - wish.cuts()[d][p]);
  DM grid;
  if constexpr (Dim == 2)
    petsc_check(DMDACreate2d(comm, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_BOX,
                             geometry.nodes[0], geometry.nodes[1], ranks[0], ranks[1], 1, 0,
                             parts[0].data(), parts[1].data(), &grid));
  else
    petsc_check(DMDACreate3d(comm, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE,
                             DMDA_STENCIL_BOX, geometry.nodes[0], geometry.nodes[1],
                             geometry.nodes[2], ranks[0], ranks[1], ranks[2], 1, 0, parts[0].data(),
                             parts[1].data(), parts[2].data(), &grid));
  petsc_check(DMSetUp(grid));
  const PetscInt* lengths[3] = {nullptr, nullptr, nullptr};
  petsc_check(DMDAGetOwnershipRanges(grid, &lengths[0], &lengths[1], &lengths[2]));
  typename Ownership<Dim>::Cuts cuts;
  for (int d = 0; d < Dim; ++d) {
    cuts[d].push_back(0);
    for (int p = 0; p < ranks[d]; ++p)
      cuts[d].push_back(cuts[d].back() + LocalIndex(lengths[d][p]));
  }
  petsc_check(DMDestroy(&grid));
  return {geometry, std::move(cuts)};
}

}  // namespace

template <int Dim>
Decomposition<Dim>::Decomposition(MPI_Comm comm, const Ownership<Dim>& ownership)
    : comm_(comm),
      rank_(rank_of(comm)),
      ownership_(ownership.by_cuts() ? through_dmda(comm, ownership) : ownership)
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
