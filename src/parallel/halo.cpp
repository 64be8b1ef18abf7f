#include <mpm/parallel/halo.hpp>

#include <algorithm>

#include "petsc_check.hpp"
#include <petscsf.h>

namespace mpm {

/// The PetscSF, buffers and one MPI type per number of values.
template <int Dim>
class Halo<Dim>::Exchange {
 public:
  static constexpr int most_values = 1 + 2 * Dim;

  Exchange(MPI_Comm comm, std::size_t shared, std::vector<PetscSFNode> sources)
      : own(shared * most_values), received(sources.size() * most_values)
  {
    petsc_check(PetscSFCreate(comm, &graph_));
    petsc_check(PetscSFSetGraph(graph_, PetscInt(shared), PetscInt(sources.size()), nullptr,
                                PETSC_COPY_VALUES, sources.data(), PETSC_COPY_VALUES));
    petsc_check(PetscSFSetUp(graph_));
    for (int values = 1; values <= most_values; ++values) {
      MPI_Type_contiguous(values, MPI_DOUBLE, &types_[values]);
      MPI_Type_commit(&types_[values]);
    }
  }
  ~Exchange()
  {
    for (int values = 1; values <= most_values; ++values) MPI_Type_free(&types_[values]);
    PetscSFDestroy(&graph_);
  }
  void run(int values)
  {
    petsc_check(
        PetscSFBcastBegin(graph_, types_[values], own.data(), received.data(), MPI_REPLACE));
    petsc_check(PetscSFBcastEnd(graph_, types_[values], own.data(), received.data(), MPI_REPLACE));
  }

  std::vector<double> own, received;

 private:
  PetscSF graph_;
  MPI_Datatype types_[most_values + 1];
};

namespace {

/// Global numbers of the nodes that `rank` shares with any other rank, ascending by local number.
template <int Dim>
std::vector<LocalIndex> shared_nodes_of(const Decomposition<Dim>& decomposition, int support,
                                        int rank)
{
  const IndexBox<Dim> mine = decomposition.local(rank, support);
  std::vector<LocalIndex> nodes;
  for (int other = 0; other < decomposition.ranks(); ++other) {
    if (other == rank) continue;
    const IndexBox<Dim> both = intersection(mine, decomposition.local(other, support));
    if (both.empty()) continue;
    const IndexVec<Dim> count = both.count(), width = mine.count();
    for (GlobalIndex k = 0; k < both.size(); ++k) {
      GlobalIndex rest = k;
      LocalIndex node = 0, stride = 1;
      for (int d = 0; d < Dim; ++d) {
        node += stride * LocalIndex(rest % count[d] + both.lower[d] - mine.lower[d]);
        rest /= count[d];
        stride *= width[d];
      }
      nodes.push_back(node);
    }
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

template <int Dim>
LocalIndex local_number(const IndexBox<Dim>& box, const IndexVec<Dim>& node)
{
  LocalIndex number = 0, stride = 1;
  for (int d = 0; d < Dim; ++d) {
    number += stride * (node[d] - box.lower[d]);
    stride *= box.count()[d];
  }
  return number;
}

LocalIndex position_in(const std::vector<LocalIndex>& sorted, LocalIndex value)
{
  return LocalIndex(std::ranges::lower_bound(sorted, value) - sorted.begin());
}

}  // namespace

template <int Dim>
Halo<Dim>::Halo(const Decomposition<Dim>& decomposition, int support)
    : rank_(decomposition.rank()),
      shared_(shared_nodes_of(decomposition, support, decomposition.rank()))
{
  const IndexBox<Dim> mine = decomposition.local(rank_, support);
  std::vector<PetscSFNode> sources;
  for (int other = 0; other < decomposition.ranks(); ++other) {
    if (other == rank_) continue;
    const IndexBox<Dim> theirs = decomposition.local(other, support);
    const IndexBox<Dim> both = intersection(mine, theirs);
    if (both.empty()) continue;
    const std::vector<LocalIndex> their_shared = shared_nodes_of(decomposition, support, other);
    Sharer sharer{other, {}, sources.size()};
    for (GlobalIndex k = 0; k < both.size(); ++k) {
      GlobalIndex rest = k;
      IndexVec<Dim> node;
      for (int d = 0; d < Dim; ++d) {
        node[d] = both.lower[d] + LocalIndex(rest % both.count()[d]);
        rest /= both.count()[d];
      }
      sharer.positions.push_back(position_in(shared_, local_number(mine, node)));
      sources.push_back({other, position_in(their_shared, local_number(theirs, node))});
    }
    sharers_.push_back(std::move(sharer));
  }
  received_ = sources.size();
  exchange_ = std::make_unique<Exchange>(decomposition.comm(), shared_.size(), sources);
}

template <int Dim>
Halo<Dim>::~Halo() = default;

template <int Dim>
template <class Count, class Place>
void Halo<Dim>::sum(Count, Place place)
{
  constexpr int values = Count::value;
  if (sharers_.empty()) return;
  for (std::size_t k = 0; k < shared_.size(); ++k)
    for (int v = 0; v < values; ++v) exchange_->own[k * values + v] = *place(shared_[k], v);
  exchange_->run(values);
  for (const LocalIndex node : shared_)
    for (int v = 0; v < values; ++v) *place(node, v) = 0;
  const auto add_own = [&] {
    for (std::size_t k = 0; k < shared_.size(); ++k)
      for (int v = 0; v < values; ++v) *place(shared_[k], v) += exchange_->own[k * values + v];
  };
  bool own_added = false;
  for (const Sharer& sharer : sharers_) {
    if (!own_added && sharer.rank > rank_) add_own(), own_added = true;
    const double* from = exchange_->received.data() + sharer.first * values;
    for (const LocalIndex position : sharer.positions)
      for (int v = 0; v < values; ++v) *place(shared_[position], v) += *from++;
  }
  if (!own_added) add_own();
}

template <int Dim>
void Halo<Dim>::sum_mass_momentum_force(NodeGrid<Dim>& grid)
{
  sum(std::integral_constant<int, 1 + 2 * Dim>{}, [&](LocalIndex node, int v) {
    return v == 0 ? &grid.mass[node]
                  : &grid.momentum_force[std::size_t(node) * grid.record_width + v - 1];
  });
}

template <int Dim>
void Halo<Dim>::sum_mass_momentum(NodeGrid<Dim>& grid)
{
  sum(std::integral_constant<int, 1 + Dim>{}, [&](LocalIndex node, int v) {
    return v == 0 ? &grid.mass[node]
                  : &grid.momentum_force[std::size_t(node) * grid.record_width + v - 1];
  });
}

template <int Dim>
void Halo<Dim>::sum_force(NodeGrid<Dim>& grid)
{
  sum(std::integral_constant<int, Dim>{}, [&](LocalIndex node, int v) {
    return &grid.momentum_force[std::size_t(node) * grid.record_width + Dim + v];
  });
}

template <int Dim>
void Halo<Dim>::sum_remapped_momentum(NodeGrid<Dim>& grid)
{
  sum(std::integral_constant<int, Dim>{}, [&](LocalIndex node, int v) {
    return &grid.remapped_momentum[std::size_t(node) * grid.remap_width + v];
  });
}

template <int Dim>
typename Halo<Dim>::Traffic Halo<Dim>::traffic() const
{
  return {int(sharers_.size()), GlobalIndex(shared_.size()), GlobalIndex(received_)};
}

template class Halo<2>;
template class Halo<3>;

}  // namespace mpm
