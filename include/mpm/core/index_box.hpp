#pragma once
/// A box of grid indices, lower bound included, upper bound excluded.

#include <mpm/core/types.hpp>

#include <algorithm>
#include <vector>

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

/// Visits every index of the box, x fastest: the order of local numbers.
template <int Dim, class Visit>
void for_each_index(const IndexBox<Dim>& box, Visit visit)
{
  if (box.empty()) return;
  IndexVec<Dim> at = box.lower;
  for (;;) {
    visit(at);
    int d = 0;
    while (d < Dim && ++at[d] == box.upper[d]) at[d] = box.lower[d], ++d;
    if (d == Dim) return;
  }
}

/// Place of an index in that order.
template <int Dim>
LocalIndex number_in(const IndexBox<Dim>& box, const IndexVec<Dim>& index)
{
  LocalIndex number = 0;
  for (int d = Dim; d-- > 0;)
    number = number * (box.upper[d] - box.lower[d]) + index[d] - box.lower[d];
  return number;
}

/// Marks what lies up to `below` and `above` indices from a marked one along every axis; one mark
/// per index of a box with `count` of them, x fastest.
template <int Dim>
void grow(std::vector<char>& marked, const IndexVec<Dim>& count, LocalIndex below, LocalIndex above)
{
  const LocalIndex size = LocalIndex(marked.size());
  LocalIndex stride = 1;
  for (int d = 0; d < Dim; ++d) {
    const std::vector<char> source = marked;
    for (LocalIndex k = 0; k < size; ++k) {
      if (!source[k]) continue;
      const LocalIndex at = k / stride % count[d];
      const LocalIndex from = std::max(at - below, 0), to = std::min(at + above, count[d] - 1);
      for (LocalIndex i = from; i <= to; ++i) marked[k + (i - at) * stride] = 1;
    }
    stride *= count[d];
  }
}

}  // namespace mpm
