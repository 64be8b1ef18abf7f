#include <mpm/core/error.hpp>
#include <mpm/parallel/node_vector.hpp>

#include <algorithm>
#include <limits>

#include "petsc_check.hpp"
#include <fmt/format.h>
#include <petscmat.h>

namespace mpm {

template <int Dim>
NodeRows<Dim>::NodeRows(const Decomposition<Dim>& decomposition, const GridTopology<Dim>& topology,
                        Halo& halo, std::span<const char> active)
    : comm_(decomposition.comm()), topology_(topology), halo_(halo)
{
  MPM_ASSERT(LocalIndex(active.size()) == topology.size());
  // Node by number, of this rank's range of numbers; -1: inactive.
  const std::vector<GlobalIndex> numbers = decomposition.numbers_of_owned();
  std::vector<LocalIndex> numbered(numbers.size(), -1);
  const GlobalIndex lowest = numbers.empty() ? 0 : std::ranges::min(numbers);
  std::size_t next = 0;
  for (LocalIndex node = 0; node < topology.size(); ++node)
    if (topology.is_owned(node)) {
      if (active[node]) numbered[std::size_t(numbers[next] - lowest)] = node;
      ++next;
    }
  MPM_ASSERT(next == numbers.size());
  std::ranges::copy_if(numbered, std::back_inserter(owned_), [](LocalIndex n) { return n >= 0; });

  const GlobalIndex own = GlobalIndex(owned_.size());
  MPI_Scan(&own, &first_, 1, MPI_INT64_T, MPI_SUM, comm_);
  first_ -= own;
  MPI_Allreduce(&own, &count_, 1, MPI_INT64_T, MPI_SUM, comm_);

  // One more than the row, so that 0 is what nobody has. A double counts to 2^53.
  std::vector<double> found(topology.size(), 0.0);
  for (std::size_t k = 0; k < owned_.size(); ++k) found[owned_[k]] = double(first_) + double(k + 1);
  const NodeColumn column{found.data(), 1, 1};
  halo_.sum(std::span(&column, 1));
  rows_.reserve(found.size());
  for (const double row : found) rows_.push_back(GlobalIndex(row) - 1);
}

template <int Dim>
void NodeRows<Dim>::expect_countable(int width) const
{
  constexpr GlobalIndex most = std::numeric_limits<PetscInt>::max();
  if (count_ <= most / width) return;
  throw InputError(fmt::format(
      "{} active nodes with {} unknowns each are more than the installed PETSc counts ({}). Use a "
      "coarser grid, or a PETSc that was configured with 64-bit indices.",
      count_, width, most));
}

template <int Dim>
VectorHandle NodeRows<Dim>::vector(int width) const
{
  expect_countable(width);
  ::Vec vector;
  petsc_check(VecCreate(comm_, &vector));
  VectorHandle handle(vector);
  petsc_check(VecSetSizes(vector, PetscInt(owned_.size()) * width, PetscInt(count_) * width));
  petsc_check(VecSetBlockSize(vector, width));
  petsc_check(VecSetFromOptions(vector));
  petsc_check(VecSet(vector, 0));
  return handle;
}

/// How many rows of this rank and of others each of its rows is coupled with.
template <int Dim>
struct NodeRows<Dim>::Couplings {
  std::vector<PetscInt> own, others;
};

template <int Dim>
auto NodeRows<Dim>::couplings(LocalIndex reach) const -> Couplings
{
  Couplings couplings;
  const GlobalIndex end = first_ + GlobalIndex(owned_.size());
  std::vector<GlobalIndex> row;
  for (const LocalIndex node : owned_) {
    const IndexVec<Dim> at = topology_.index(node);
    const IndexBox<Dim> around{(at.array() - reach).matrix(), (at.array() + reach + 1).matrix()};
    row.clear();
    for_each_index(intersection(around, topology_.local()), [&](const IndexVec<Dim>& other) {
      const GlobalIndex column = rows_[topology_.index_of(other)];
      if (column >= 0) row.push_back(column);
    });
    // Where an axis begins again after a few nodes, a node is met more than once.
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    const auto own =
        std::ranges::count_if(row, [&](GlobalIndex r) { return r >= first_ && r < end; });
    couplings.own.push_back(PetscInt(own));
    couplings.others.push_back(PetscInt(row.size()) - PetscInt(own));
  }
  return couplings;
}

template <int Dim>
MatrixHandle NodeRows<Dim>::matrix(int width, LocalIndex reach) const
{
  expect_countable(width);
  const Couplings room = couplings(reach);
  Mat matrix;
  petsc_check(MatCreate(comm_, &matrix));
  MatrixHandle handle(matrix);
  const PetscInt own = PetscInt(owned_.size()) * width, all = PetscInt(count_) * width;
  petsc_check(MatSetSizes(matrix, own, own, all, all));
  petsc_check(MatSetFromOptions(matrix));
  petsc_check(MatXAIJSetPreallocation(matrix, width, room.own.data(), room.others.data(), nullptr,
                                      nullptr));
  return handle;
}

template <int Dim>
void NodeRows<Dim>::to_vector(const NodeColumn& column, _p_Vec* vector) const
{
  PetscScalar* to;
  petsc_check(VecGetArrayWrite(vector, &to));
  PetscScalar* next = to;
  for (const LocalIndex node : owned_)
    next = std::copy_n(column.values + std::size_t(node) * column.stride, column.width, next);
  petsc_check(VecRestoreArrayWrite(vector, &to));
}

template <int Dim>
void NodeRows<Dim>::from_vector(_p_Vec* vector, const NodeColumn& column) const
{
  for (LocalIndex node = 0; node < topology_.size(); ++node)
    std::fill_n(column.values + std::size_t(node) * column.stride, column.width, 0.0);
  const PetscScalar* from;
  petsc_check(VecGetArrayRead(vector, &from));
  const PetscScalar* next = from;
  for (const LocalIndex node : owned_) {
    std::copy_n(next, column.width, column.values + std::size_t(node) * column.stride);
    next += column.width;
  }
  petsc_check(VecRestoreArrayRead(vector, &from));
  halo_.sum(std::span(&column, 1));  // all terms but the owner's are 0
}

template class NodeRows<2>;
template class NodeRows<3>;

}  // namespace mpm
