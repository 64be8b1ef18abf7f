#pragma once
/// How far corners of a lattice stand from where the lattice has them.

#include <mpm/core/index_order.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mpm {

/// m; corners that are not listed stand on the lattice.
template <int Dim>
class CornerOffsets {
  struct Corner {
    IndexVec<Dim> at;
    Vec<Dim> offset, way;
  };

 public:
  static constexpr std::size_t bytes_of_corner = sizeof(Corner);

  void reserve(std::size_t corners) { corners_.reserve(corners); }
  /// `way`: from there to where contact sees it.
  void add(const IndexVec<Dim>& at, const Vec<Dim>& offset, const Vec<Dim>& way = Vec<Dim>::Zero())
  {
    corners_.push_back({at, offset, way});
  }
  /// Once all are added, and before any is asked for. One that was added again stays once.
  void seal()
  {
    std::ranges::sort(corners_, stands_before<Dim>, &Corner::at);
    const auto is_same = [](const Corner& a, const Corner& b) { return a.at == b.at; };
    corners_.erase(std::unique(corners_.begin(), corners_.end(), is_same), corners_.end());
    corners_.shrink_to_fit();
  }

  bool empty() const { return corners_.empty(); }
  Vec<Dim> operator()(const IndexVec<Dim>& at) const { return of(at, &Corner::offset); }
  Vec<Dim> way(const IndexVec<Dim>& at) const { return of(at, &Corner::way); }
  std::size_t bytes() const { return corners_.capacity() * bytes_of_corner; }

 private:
  Vec<Dim> of(const IndexVec<Dim>& at, Vec<Dim> Corner::*value) const
  {
    const auto found = std::ranges::lower_bound(corners_, at, stands_before<Dim>, &Corner::at);
    if (found == corners_.end() || found->at != at) return Vec<Dim>::Zero();
    return *found.*value;
  }

  std::vector<Corner> corners_;  ///< in the order in which a lattice is gone through
};

}  // namespace mpm
