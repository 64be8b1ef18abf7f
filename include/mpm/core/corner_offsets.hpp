#pragma once
/// How far corners of a lattice stand from where the lattice has them.

#include <mpm/core/index_box.hpp>

#include <vector>

namespace mpm {

/// Of a box of corners, m; corners beyond it stand on the lattice.
template <int Dim>
struct CornerOffsets {
  IndexBox<Dim> corners{};
  std::vector<Vec<Dim>> offsets;  ///< x fastest; empty: all stand on the lattice
  std::vector<Vec<Dim>> ways;     ///< from there to where contact sees them

  bool empty() const { return offsets.empty(); }
  Vec<Dim> operator()(const IndexVec<Dim>& corner) const
  {
    if (empty() || !corners.contains(corner)) return Vec<Dim>::Zero();
    return offsets[std::size_t(number_in(corners, corner))];
  }
  Vec<Dim> way(const IndexVec<Dim>& corner) const
  {
    if (ways.empty() || !corners.contains(corner)) return Vec<Dim>::Zero();
    return ways[std::size_t(number_in(corners, corner))];
  }
};

}  // namespace mpm
