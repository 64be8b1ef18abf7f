#pragma once
/// Nodes that belong to a body and move with it.

#include <mpm/core/corner_offsets.hpp>
#include <mpm/core/lane_vector.hpp>
#include <mpm/grid/grid_topology.hpp>
#include <mpm/grid/node_fields.hpp>

#include <cstddef>
#include <vector>

namespace mpm {

/// Corners of a lattice of locations, which stand on the lattice at time 0, or beside it.
template <int Dim>
class MeshNodes final : public Nodes<Dim> {
 public:
  /// `corners` of the lattice, `size` of a location, m, `period` in locations, 0 for axes without.
  MeshNodes(std::vector<IndexVec<Dim>> corners, std::vector<char> owned, const Vec<Dim>& size,
            const IndexVec<Dim>& period, const CornerOffsets<Dim>& offsets = {});
  /// Of nodes that share a corner: each has one of its own, the same on every rank.
  void set_kinds(std::vector<char> kinds) { kinds_ = std::move(kinds); }

  LocalIndex size() const override { return LocalIndex(owned_.size()); }
  void find_within(const Region<Dim>& region, std::vector<LocalIndex>& nodes) const override;
  GlobalIndex listing() const override { return listing_; }
  /// Another one of every mesh: what is known by a node's number is of one alone.
  GlobalIndex mesh() const { return mesh_; }
  Vec<Dim> position(LocalIndex node) const override;
  bool is_owned(LocalIndex node) const override { return owned_[std::size_t(node)]; }
  const Vec<Dim>& spacing() const override { return location_size_; }
  Vec<Dim> period() const override;

  /// m, on the lattice: at time 0, but for its offset.
  double rest(LocalIndex node, int axis) const
  {
    return corners_[std::size_t(node)][axis] * location_size_[axis];
  }
  const IndexVec<Dim>& corner(LocalIndex node) const { return corners_[std::size_t(node)]; }
  /// Its place, m: a row of two, in space of four values, which cells read at once.
  const double* place_of(LocalIndex node) const
  {
    return places_.data() + std::size_t(node) * place_width;
  }
  static constexpr int place_width = Dim == 2 ? 2 : 4;
  /// x += dt v with the updated velocities, which become the momentum; forces are 0 then. Returns
  /// the largest component of the velocities of nodes that are not free, m/s.
  double move(NodeFields<Dim>& fields, double dt);

  /// Which nodes go with a rigid body: walls leave them alone. At the start none.
  void set_led(std::vector<char> led) { led_ = std::move(led); }
  bool is_led(LocalIndex node) const { return !led_.empty() && led_[std::size_t(node)]; }
  /// Which nodes fly freely, as no cell of this rank holds them any more; at the start none.
  void set_free(std::vector<char> free) { free_ = std::move(free); }
  bool is_free(LocalIndex node) const { return !free_.empty() && free_[std::size_t(node)]; }

  /// m, that no node has gone farther along an axis since time 0.
  double way() const { return way_; }

  /// All of them.
  NodeRun<Dim> run() const { return {0, size(), IndexVec<Dim>::Zero()}; }
  /// Returns, where they are regrouped, which of all ranks' nodes these are.
  std::vector<std::int64_t> archive(Archive& archive);
  std::size_t bytes() const;

 private:
  GlobalIndex key(LocalIndex node, const IndexVec<Dim>& corner) const;
  std::vector<std::int64_t> find_saved(Archive& archive, std::vector<IndexVec<Dim>>& saved) const;

  std::vector<IndexVec<Dim>> corners_;
  std::vector<char> kinds_;  ///< empty where each corner has one node
  std::vector<char> owned_;
  std::vector<char> led_;   ///< empty where none is
  std::vector<char> free_;  ///< empty where none is
  Vec<Dim> location_size_;
  IndexVec<Dim> period_;
  double& place(LocalIndex node, int axis)
  {
    return places_[std::size_t(node) * place_width + std::size_t(axis)];
  }

  LaneVector<double> places_;
  double way_ = 0;
  GlobalIndex mesh_, listing_;
};

/// What such nodes carry.
template <int Dim>
typename NodeFields<Dim>::Needs mesh_needs(bool loads)
{
  return {.load_force = loads, .gradient = false};
}

}  // namespace mpm
