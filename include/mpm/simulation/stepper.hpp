#pragma once
/// The explicit step: update orders made of particle passes, grid updates, conditions and exchange.

#include <mpm/conditions/boundary_condition.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/migration.hpp>
#include <mpm/transfer/transfer.hpp>

#include <memory>
#include <vector>

namespace mpm {

enum class UpdateOrderKind {
  musl,  ///< modified update stress last: velocity gradient of the re-mapped grid velocity
  usf,   ///< update stress first
  usl    ///< update stress last, without re-mapping
};

/// Sulsky, Zhou & Schreyer 1995 (CPC 87:236); Bardenhagen 2002 (JCP 180:383); Nairn 2003 (CMES
/// 4:649). Between steps the grid holds the sums of the particles' present state, so that every
/// step begins with the grid update and ends with particles complete in position, velocity and
/// stress.
template <int Dim>
class Stepper {
 public:
  struct Setup {
    UpdateOrderKind order = UpdateOrderKind::musl;
    double mass_cut = 0;  ///< kg; nodes with less are not active
  };

  Stepper(const Decomposition<Dim>& decomposition, std::unique_ptr<Transfer<Dim>> transfer,
          std::vector<Body<Dim>> bodies,
          std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions, const Setup& setup);

  /// One step. Collective. Throws NumericalError on every rank if a particle of any rank left the
  /// grid or stopped being a number.
  void step(double dt);

  double time() const { return time_; }
  GlobalIndex steps() const { return steps_; }
  std::vector<Body<Dim>>& bodies() { return bodies_; }
  const std::vector<Body<Dim>>& bodies() const { return bodies_; }
  const NodeGrid<Dim>& grid() const { return grid_; }
  const Halo<Dim>& halo() const { return halo_; }
  const Decomposition<Dim>& decomposition() const { return decomposition_; }
  LocalIndex particles() const;
  GlobalIndex migrated() const { return migrated_; }
  /// Largest component of a particle's grid velocity in the last step on this rank, m/s.
  double largest_speed() const { return largest_speed_; }

 private:
  void begin_grid();
  void musl(double dt);
  void usf(double dt);
  void usl(double dt);
  void update_grid_velocity(double dt);
  void constrain_gradient(double dt);
  /// After particles have moved: particles that left go to their owner; order and activity are
  /// renewed when due.
  void finish_move(std::vector<MoveOutcome<Dim>>& outcomes, double dt);
  void sort_and_activate();
  [[noreturn]] void stop(const std::vector<MoveOutcome<Dim>>& outcomes);

  const Decomposition<Dim>& decomposition_;
  std::unique_ptr<Transfer<Dim>> transfer_;
  std::vector<Body<Dim>> bodies_;
  std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions_;
  Setup setup_;
  NodeGrid<Dim> grid_;
  Halo<Dim> halo_;
  Migration<Dim> migration_;
  MoveBounds<Dim> bounds_;

  double time_ = 0;
  GlobalIndex steps_ = 0;
  GlobalIndex migrated_ = 0;
  double largest_speed_ = 0;
  double moved_since_sort_ = 0;  ///< m, bound on any particle's motion
  int steps_since_sort_ = 0;
  std::vector<LocalIndex> first_nodes_, order_, counts_;
};

}  // namespace mpm
