#pragma once
/// The nodes of this rank: what it owns and the halo around it, and the values they hold in a step.

#include <mpm/core/lane_vector.hpp>
#include <mpm/core/index_box.hpp>

#include <vector>

namespace mpm {

/// The regular background grid of the whole run.
template <int Dim>
struct GridGeometry {
  Vec<Dim> origin;      ///< m, of node 0
  Vec<Dim> spacing;     ///< m, each axis its own
  IndexVec<Dim> nodes;  ///< per axis

  double smallest_spacing() const { return spacing.minCoeff(); }
  double node_position(int axis, LocalIndex index) const
  {
    return origin[axis] + spacing[axis] * index;
  }
  /// Cell that holds a position; floor((x - origin) / h).
  IndexVec<Dim> cell_of(const Vec<Dim>& position) const;
};

/// Nodes next to each other in a row: [first, first + length) in local numbering.
template <int Dim>
struct NodeRun {
  LocalIndex first;
  LocalIndex length;
  IndexVec<Dim> start;  ///< global index of the first node
};

template <int Dim>
class NodeGrid {
 public:
  /// Width of a node's record: momentum and force, or updated velocity and its increment.
  static constexpr int record_width = Dim == 2 ? 4 : 8;
  /// In 2D the velocity is there twice, so that one product yields both columns of its gradient.
  static constexpr int velocity_width = 4;
  static constexpr int remap_width = Dim == 2 ? 2 : 4;

  /// `owned`: one mark per local node; each node of the whole grid has one owner.
  NodeGrid(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local, std::vector<char> owned,
           double mass_cut);
  /// Owns the nodes of a box.
  NodeGrid(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
           const IndexBox<Dim>& owned, double mass_cut);

  const GridGeometry<Dim>& geometry() const { return geometry_; }
  const IndexBox<Dim>& local() const { return local_; }
  bool is_owned(LocalIndex node) const { return owned_[node]; }
  LocalIndex size() const { return size_; }
  LocalIndex stride(int axis) const { return stride_[axis]; }
  LocalIndex index_of(const IndexVec<Dim>& global) const
  {
    return LocalIndex((global - local_.lower).dot(stride_));
  }
  bool is_active(LocalIndex node) const { return mass[node] > mass_cut_; }

  /// Zeroes mass, momentum and force of the active nodes.
  void reset();
  void reset_remap();

  /// Active nodes: those that particles can reach before the next such call, and the ones that
  /// must stay active because other ranks reach them. Everything else is never touched. Between
  /// begin and end, `touch` marks the first stencil node of every particle.
  ///
  /// Shared nodes stay active, and one node around them: that is where particles arrive.
  void keep_active(const std::vector<LocalIndex>& shared_nodes);
  void begin_activity() { std::fill(touched_.begin(), touched_.end(), char(0)); }
  void touch(LocalIndex base_node) { touched_[base_node] = 1; }
  void end_activity(int support);
  const std::vector<NodeRun<Dim>>& runs() const { return runs_; }
  LocalIndex active_nodes() const;

  /// v = mv / m, dv = dt f / m: `updated` becomes {v + dv, dv}.
  void update_velocity(double dt);
  /// `gradient_velocity` becomes momentum / m (USF), re-mapped momentum / m (MUSL), or the updated
  /// velocity (USL).
  void gradient_from_momentum();
  void gradient_from_remap();
  void gradient_from_updated();

  double* updated_of(LocalIndex node) { return updated.data() + std::size_t(node) * record_width; }
  double* gradient_velocity_of(LocalIndex node)
  {
    return gradient_velocity.data() + std::size_t(node) * velocity_width;
  }
  void set_gradient_velocity(LocalIndex node, int component, double value);

  std::size_t bytes() const;

  // Node values, local numbering, x fastest. [N], [N * record_width], ...; kg, kg m/s and N, m/s.
  LaneVector<double> mass;
  LaneVector<double> momentum_force;     ///< {mv, f}
  LaneVector<double> updated;            ///< {v after the step, its increment dt a}
  LaneVector<double> remapped_momentum;  ///< MUSL
  LaneVector<double> gradient_velocity;  ///< what the velocity gradient is taken of

 private:
  GridGeometry<Dim> geometry_;
  IndexBox<Dim> local_;
  IndexVec<Dim> stride_;
  LocalIndex size_;
  double mass_cut_;
  std::vector<char> owned_, touched_, kept_;
  std::vector<NodeRun<Dim>> runs_;
};

}  // namespace mpm
