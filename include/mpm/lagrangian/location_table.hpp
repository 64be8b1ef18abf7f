#pragma once
/// Values at some locations of a lattice, found without a search.

#include <mpm/core/index_box.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// Keeps whole tiles of locations where at least one has a value, so that a lattice that is mostly
/// empty costs little: four bytes a tile.
template <int Dim, class Value>
class LocationTable {
 public:
  LocationTable() = default;
  /// For locations in `box`; all of them have `empty`.
  LocationTable(const IndexBox<Dim>& box, const Value& empty)
      : box_(box),
        tiles_{IndexVec<Dim>::Zero(), (box.count().array() + edge - 1).matrix() / edge},
        empty_(empty),
        first_(box.empty() ? 0 : std::size_t(tiles_.size()), -1)
  {
  }

  /// `empty` beyond the box.
  const Value& operator()(const IndexVec<Dim>& location) const
  {
    if (!box_.contains(location)) return empty_;
    const std::ptrdiff_t first = first_[tile_of(location)];
    return first < 0 ? empty_ : values_[std::size_t(first) * tile_size + place_of(location)];
  }
  /// Of a location in the box.
  Value& at(const IndexVec<Dim>& location)
  {
    LocalIndex& first = first_[tile_of(location)];
    if (first < 0) {
      first = LocalIndex(values_.size() / tile_size);
      values_.resize(values_.size() + tile_size, empty_);
    }
    return values_[std::size_t(first) * tile_size + place_of(location)];
  }

 private:
  static constexpr LocalIndex edge = Dim == 2 ? 16 : 8;
  static constexpr std::size_t tile_size = Dim == 2 ? edge * edge : edge * edge * edge;

  std::size_t tile_of(const IndexVec<Dim>& location) const
  {
    std::size_t tile = 0;
    for (int d = Dim; d-- > 0;)
      tile =
          tile * std::size_t(tiles_.upper[d]) + std::size_t((location[d] - box_.lower[d]) / edge);
    return tile;
  }
  std::size_t place_of(const IndexVec<Dim>& location) const
  {
    std::size_t place = 0;
    for (int d = Dim; d-- > 0;)
      place = place * edge + std::size_t((location[d] - box_.lower[d]) % edge);
    return place;
  }

  IndexBox<Dim> box_, tiles_;
  Value empty_{};
  std::vector<LocalIndex> first_;  ///< of each tile: which of those that are kept, or -1
  std::vector<Value> values_;      ///< of the kept tiles in turn, x fastest
};

/// The least box around `locations`.
template <int Dim>
IndexBox<Dim> box_around(std::span<const IndexVec<Dim>> locations)
{
  if (locations.empty()) return {};
  IndexBox<Dim> box{locations.front(), locations.front()};
  for (const IndexVec<Dim>& at : locations) {
    box.lower = box.lower.cwiseMin(at);
    box.upper = box.upper.cwiseMax(at);
  }
  box.upper.array() += 1;
  return box;
}

}  // namespace mpm
