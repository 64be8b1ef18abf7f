#pragma once
/// What the nodes carry in a step: the columns of one velocity field. Bodies that move as one share
/// a field; bodies in contact, or the sides of a contact, have one each.

#include <mpm/core/archive.hpp>
#include <mpm/core/lane_vector.hpp>
#include <mpm/grid/grid_topology.hpp>

#include <optional>
#include <span>

namespace mpm {

/// Values of nodes somewhere in memory, `width` of them per node:
/// value c of node i is values[i * stride + c].
struct NodeColumn {
  double* values;
  int stride;
  int width;
};

template <int Dim>
class NodeFields {
 public:
  /// Width of a node's record: momentum and force, or updated velocity and its increment.
  static constexpr int record_width = Dim == 2 ? 4 : 8;
  /// Where the mass rides in the record of momentum and force: its sum then costs nothing. In the
  /// plane the record is full.
  static constexpr std::optional<int> mass_slot =
      Dim == 3 ? std::optional<int>(2 * Dim) : std::nullopt;
  /// In 2D the velocity is there twice, so that one product yields both columns of its gradient.
  static constexpr int velocity_width = 4;
  static constexpr int remap_width = Dim == 2 ? 2 : 4;
  static constexpr int surface_width = Dim + Dim * (Dim + 1) / 2;
  /// Sums that a step with mass, momentum and force sends for each node.
  static constexpr int values_per_node = 1 + 2 * Dim;

  /// What an update order needs beside mass, momentum, force and velocities.
  struct Needs {
    bool remap = false;       ///< re-mapped momentum, also in refinements and means
    bool load_force = false;  ///< force from outside, for its work
    bool gradient = true;     ///< velocity whose gradient particles take
    bool surface = false;     ///< where the body's surface lies, for contact
  };

  /// `mass_cut`, kg: nodes with less take no part.
  NodeFields(LocalIndex nodes, const Needs& needs, double mass_cut);

  bool is_active(LocalIndex node) const { return mass_of(node) > mass_cut_; }

  using Runs = std::span<const NodeRun<Dim>>;
  /// Zeroes mass, momentum, force and load force.
  void reset(Runs runs);
  void reset_remap(Runs runs);
  void reset_surface(Runs runs);
  /// Zeroes everything that these nodes carry.
  void clear(std::span<const LocalIndex> nodes);

  /// f += load force
  void add_load_force(Runs runs);
  /// v = mv / m, dv = dt f / m: `updated` becomes {v + dv, dv}.
  void update_velocity(Runs runs, double dt);
  /// mv = m v with the updated velocity: for nodes that keep it.
  void carry_momentum(Runs runs);
  /// The updated velocity v of the lumped mass matrix is the first approximation v_1 of the one of
  /// the full matrix, and the first residual: r_1 = v_1, which takes the place of the increment.
  /// With `before_forces` r_1 = v_1 - dv, and the increment stays what the lumped matrix says.
  void begin_refinement(Runs runs, bool before_forces);
  /// With the re-mapped momentum m S+ S r_k: v_k+1 = v_k + r_k+1, r_k+1 = r_k - S+ S r_k.
  /// Conditions may then change the updated velocity; `end_refinement` takes r_k+1 from what is
  /// left. `gradient_velocity` holds v_k in between.
  void refine(Runs runs);
  void end_refinement(Runs runs);
  /// The re-mapped momentum's first component, a mass times a divergence, becomes that divergence,
  /// 1/s: the mean around the node.
  void divergence_from_remap(Runs runs);
  /// `gradient_velocity` becomes momentum / m (USF), re-mapped momentum / m (MUSL), or the updated
  /// velocity (USL).
  void gradient_from_momentum(Runs runs);
  void gradient_from_remap(Runs runs);
  void gradient_from_updated(Runs runs);

  double& mass_of(LocalIndex node)
  {
    if constexpr (mass_slot)
      return momentum_force[std::size_t(node) * record_width + *mass_slot];
    else
      return mass[std::size_t(node)];
  }
  double mass_of(LocalIndex node) const { return const_cast<NodeFields*>(this)->mass_of(node); }
  /// kg, on which loads act.
  double loaded_mass_of(LocalIndex node) const
  {
    return loaded_mass.empty() ? mass_of(node) : loaded_mass[std::size_t(node)];
  }
  double* updated_of(LocalIndex node) { return updated.data() + std::size_t(node) * record_width; }
  double* force_of(LocalIndex node)
  {
    return momentum_force.data() + std::size_t(node) * record_width + Dim;
  }
  double* gradient_velocity_of(LocalIndex node)
  {
    return gradient_velocity.data() + std::size_t(node) * velocity_width;
  }
  /// {sum w m r, sum w m r (x) r} with r = x_p - x_i, of the second i <= j, row by row.
  double* surface_of(LocalIndex node) { return surface.data() + std::size_t(node) * surface_width; }
  void set_gradient_velocity(LocalIndex node, int component, double value);

  // For sums over the ranks.
  NodeColumn mass_column()
  {
    if constexpr (mass_slot)
      return {slot_of_records(*mass_slot), record_width, 1};
    else
      return {mass.data(), 1, 1};
  }
  NodeColumn momentum_column() { return {momentum_force.data(), record_width, Dim}; }
  NodeColumn force_column() { return {slot_of_records(Dim), record_width, Dim}; }
  NodeColumn momentum_force_column() { return {momentum_force.data(), record_width, 2 * Dim}; }
  NodeColumn load_force_column() { return {load_force.data(), Dim, Dim}; }
  NodeColumn surface_column() { return {surface.data(), surface_width, surface_width}; }
  NodeColumn remap_column() { return {remapped_momentum.data(), remap_width, Dim}; }

  /// Regrouped, they are these nodes of all ranks'.
  void archive(Archive& archive, std::span<const std::int64_t> rows = {});
  std::size_t bytes() const;

  // Node values, local numbering, x fastest. [N], [N * record_width], ...; kg, kg m/s and N, m/s.
  LaneVector<double> mass;               ///< empty where it rides in the record
  LaneVector<double> momentum_force;     ///< {mv, f}, in space {mv, f, m, nothing}
  LaneVector<double> updated;            ///< {v after the step, its increment dt a}
  LaneVector<double> remapped_momentum;  ///< empty where it is not needed
  LaneVector<double> load_force;         ///< [N * Dim], empty where there are no loads
  std::span<const double> loaded_mass;  ///< kg, [N]: what loads act on if not on all mass, or empty
  LaneVector<double> gradient_velocity;  ///< what the velocity gradient is taken of, or empty
  LaneVector<double> surface;            ///< kg m and kg m^2, as in `surface_of`, or empty

 private:
  /// Of the first node's record; null on a rank without nodes.
  double* slot_of_records(int slot)
  {
    return momentum_force.empty() ? nullptr : momentum_force.data() + slot;
  }

  double mass_cut_;
};

}  // namespace mpm
