#pragma once
/// The explicit step: update orders made of particle passes, grid updates, conditions and exchange.

#include <mpm/conditions/boundary_condition.hpp>
#include <mpm/core/recent_least.hpp>
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/migration.hpp>
#include <mpm/simulation/stopwatch.hpp>
#include <mpm/transfer/transfer.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace mpm {

/// Sulsky, Zhou & Schreyer 1995 (CPC 87:236); Bardenhagen 2002 (JCP 180:383); Nairn 2003 (CMES
/// 4:649). Between steps the grid holds the sums of the particles' present state, so that every
/// step begins with the grid update and ends with particles complete in position, velocity and
/// stress.
///
/// In every pass the particles near other ranks come first; the rest are done while the sums on
/// shared nodes, and the particles that leave, are under way. A step has no collective: what all
/// ranks must know they agree on every `steps_between_checks` steps.
template <int Dim>
class Stepper {
 public:
  struct Setup {
    UpdateOrderKind order = UpdateOrderKind::musl;
    double mass_cut = 0;  ///< kg; nodes with less are not active
  };

  Stepper(Decomposition<Dim> decomposition, std::unique_ptr<Transfer<Dim>> transfer,
          std::vector<Body<Dim>> bodies,
          std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions, const Setup& setup);

  /// One step; collective. Every `steps_between_checks` steps it ends with `check`.
  void step(double dt);

  static constexpr GlobalIndex steps_between_checks = 20;
  /// Throws NumericalError on every rank if a particle of any rank left the grid or stopped being a
  /// number since the last check; what is measured after that means nothing. Collective.
  void check();
  /// What the ranks told each other in the last check.
  struct Agreed {
    double largest_speed = 0;  ///< m/s, component of a particle's grid velocity in the last step
    double wave_speed = 0;     ///< m/s, of the fastest wave in the particles as they are
    /// Time of work in a step, without waiting, by the quickest of the last checks: of the busiest
    /// rank, and the mean.
    double busiest_seconds = 0, mean_seconds = 0;
    double own_seconds = 0;  ///< this rank's
    GlobalIndex most_particles = 0;
    double mean_particles = 0;

    double work_imbalance() const
    {
      return mean_seconds > 0 ? busiest_seconds / mean_seconds : 1.0;
    }
    /// Particles of the fullest rank over the mean.
    double imbalance() const { return mean_particles > 0 ? most_particles / mean_particles : 1.0; }
  };
  const Agreed& agreed() const { return agreed_; }

  /// Gives the cells, and the particles in them, to other ranks. Returns how many particles this
  /// rank sent. Collective; between steps.
  GlobalIndex repartition(const Ownership<Dim>& ownership);

  UpdateOrderKind order() const { return setup_.order; }
  double time() const { return time_; }
  GlobalIndex steps() const { return steps_; }
  std::vector<Body<Dim>>& bodies() { return bodies_; }
  const std::vector<Body<Dim>>& bodies() const { return bodies_; }
  const NodeGrid<Dim>& grid() const { return grid_; }
  const Halo<Dim>& halo() const { return halo_; }
  const Decomposition<Dim>& decomposition() const { return decomposition_; }
  LocalIndex particles() const;

  /// Of this rank since the start.
  struct Counters {
    GlobalIndex migrated = 0;  ///< particles that left in a step
    GlobalIndex messages = 0, bytes = 0;
    double waiting_seconds = 0;
  };
  Counters counters() const;

 private:
  /// Blocks of a body: [0, near_end) may touch shared nodes, [near_end, rest) do not, and from
  /// `rest` on stand arrivals since the last sort.
  struct Order {
    LocalIndex near_end = 0, rest = 0;
  };
  /// The first particle of this rank that was lost, and when.
  struct Loss {
    LostParticle<Dim> particle;
    std::string body;
    GlobalIndex step;
    double time;
  };

  void connect();
  void begin_grid();
  void musl(double dt);
  void usf(double dt);
  void usl(double dt);
  void update_grid_velocity(double dt);
  void constrain_gradient(double dt);
  /// Passes over all particles that add to nodes, and the sum over the ranks.
  void pass_and_sum(NodeSum sum, const std::function<void(const BodyPart<Dim>&)>& pass);
  /// The same for one that moves them; those that left go to their owner, and order and activity
  /// are renewed when due.
  void move_and_sum(NodeSum sum, double dt,
                    const std::function<MoveOutcome<Dim>(const BodyPart<Dim>&)>& pass);
  using PartVisit = std::function<void(const BodyPart<Dim>&, std::size_t body)>;
  void visit_near(const PartVisit& visit);
  /// With a look after the messages from time to time.
  void visit_interior(const PartVisit& visit);
  void collect_sums();
  void collect_leavers();
  void exchange_leavers();
  void measure_anew()
  {
    busy_.clear();
    measured_from_ = steps_;
  }
  void note_loss(std::size_t body, const LostParticle<Dim>& lost);
  LostParticle<Dim> strayed(std::size_t body, LocalIndex particle) const;
  void sort_and_activate();
  void sort(std::size_t body, const std::vector<char>& near);
  [[noreturn]] void stop(GlobalIndex first_loss);

  Decomposition<Dim> decomposition_;
  std::unique_ptr<Transfer<Dim>> transfer_;
  std::vector<Body<Dim>> bodies_;
  std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions_;
  Setup setup_;
  NodeGrid<Dim> grid_;
  Halo<Dim> halo_;
  Migration<Dim> migration_;
  MoveBounds<Dim> bounds_;
  std::vector<char> near_;  ///< stencils with this first node may come to touch shared nodes

  double time_ = 0;
  GlobalIndex steps_ = 0;
  std::optional<Loss> loss_;  ///< set: this rank does no more passes until all ranks stop
  double largest_speed_ = 0;
  double moved_since_sort_ = 0;  ///< m, bound on any particle's motion
  int steps_since_sort_ = 0;
  std::vector<Order> orders_;
  std::vector<LocalIndex> first_nodes_, order_, counts_;

  Agreed agreed_;
  GlobalIndex checked_ = 0;  ///< step of the last check
  Stopwatch busy_;
  GlobalIndex measured_from_ = 0;  ///< step of the last `measure_anew`
  RecentLeast particle_seconds_;   ///< of work for one particle in one step
  Counters counters_;              ///< without those of the present halo and migration
};

}  // namespace mpm
