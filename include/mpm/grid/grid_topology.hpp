#pragma once
/// Which nodes of the background grid this rank holds, owns and has reached by particles. What the
/// nodes carry is in node_fields.hpp.

#include <mpm/grid/grid_geometry.hpp>
#include <mpm/grid/nodes.hpp>

#include <span>
#include <vector>

namespace mpm {

/// Nodes next to each other in a row: [first, first + length) in local numbering.
template <int Dim>
struct NodeRun {
  LocalIndex first;
  LocalIndex length;
  IndexVec<Dim> start;  ///< global index of the first node
};

/// Nodes are numbered in the rank's local box, x fastest.
template <int Dim>
class GridTopology final : public Nodes<Dim> {
 public:
  /// `owned`: one mark per local node; each node of the whole grid has one owner.
  GridTopology(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
               std::vector<char> owned);
  /// Owns the nodes of a box.
  GridTopology(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
               const IndexBox<Dim>& owned);

  const GridGeometry<Dim>& geometry() const { return geometry_; }
  const IndexBox<Dim>& local() const { return local_; }
  LocalIndex size() const override { return size_; }
  bool is_owned(LocalIndex node) const override { return owned_[node]; }
  LocalIndex stride(int axis) const { return stride_[axis]; }
  LocalIndex index_of(const IndexVec<Dim>& global) const
  {
    return LocalIndex((global - local_.lower).dot(stride_));
  }
  /// Global index of a node; of an image, where it stands.
  IndexVec<Dim> index(LocalIndex node) const;
  Vec<Dim> position(LocalIndex node) const override;
  const Vec<Dim>& spacing() const override { return geometry_.spacing; }
  Vec<Dim> period() const override;
  void find_within(const Region<Dim>& region, std::vector<LocalIndex>& nodes) const override;
  GlobalIndex listing() const override { return listing_; }

  /// Active nodes: those that particles can reach before the next such call, and the ones that
  /// must stay active because other ranks reach them. Everything else is never touched. Between
  /// begin and end, `touch` marks the first stencil node of every particle.
  ///
  /// Shared nodes stay active, and one node around them: that is where particles arrive.
  void keep_active(const std::vector<LocalIndex>& shared_nodes);
  void begin_activity() { std::fill(touched_.begin(), touched_.end(), char(0)); }
  void touch(LocalIndex base_node) { touched_[base_node] = 1; }
  bool is_touched(LocalIndex node) const { return touched_[node]; }
  /// Returns the nodes that were active and no longer are: what they carry must be cleared.
  std::vector<LocalIndex> end_activity(int support);
  std::span<const NodeRun<Dim>> runs() const { return runs_; }
  LocalIndex active_nodes() const;
  /// Nodes that were touched: first stencil nodes of particles.
  LocalIndex touched_nodes() const;

  std::size_t bytes() const { return owned_.size() + touched_.size() + kept_.size(); }

 private:
  GridGeometry<Dim> geometry_;
  IndexBox<Dim> local_;
  IndexVec<Dim> stride_;
  LocalIndex size_;
  std::vector<char> owned_, touched_, kept_;
  std::vector<NodeRun<Dim>> runs_;
  GlobalIndex listing_ = Nodes<Dim>::new_listing();
};

}  // namespace mpm
