#pragma once
/// A box of grid indices, lower bound included, upper bound excluded.

#include <mpm/core/types.hpp>

namespace mpm {

template <int Dim>
struct IndexBox {
  IndexVec<Dim> lower = IndexVec<Dim>::Zero();
  IndexVec<Dim> upper = IndexVec<Dim>::Zero();

  IndexVec<Dim> count() const { return (upper - lower).cwiseMax(0); }
  bool empty() const { return (upper.array() <= lower.array()).any(); }
  bool contains(const IndexVec<Dim>& index) const
  {
    return (index.array() >= lower.array()).all() && (index.array() < upper.array()).all();
  }
  GlobalIndex size() const { return count().template cast<GlobalIndex>().prod(); }
  friend IndexBox intersection(const IndexBox& a, const IndexBox& b)
  {
    return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
  }
  friend bool operator==(const IndexBox& a, const IndexBox& b)
  {
    return a.lower == b.lower && a.upper == b.upper;
  }
};

}  // namespace mpm
