#pragma once
/// The order in which indices of a grid or lattice are gone through.

#include <mpm/core/types.hpp>

#include <algorithm>
#include <iterator>

namespace mpm {

/// Whether for_each_index of any box that holds both visits `a` first: by their last axis, then by
/// those before it.
template <int Dim>
bool stands_before(const IndexVec<Dim>& a, const IndexVec<Dim>& b)
{
  return std::lexicographical_compare(
      std::make_reverse_iterator(a.end()), std::make_reverse_iterator(a.begin()),
      std::make_reverse_iterator(b.end()), std::make_reverse_iterator(b.begin()));
}

}  // namespace mpm
