#pragma once
/// Moves the borders between ranks when the work has moved.

#include <mpm/parallel/partition.hpp>
#include <mpm/simulation/stepper.hpp>

namespace mpm {

/// Measured: the time each rank works without waiting, and from it what a particle costs there. The
/// borders move when the busiest rank has been above the mean by more than a bound in several
/// checks, and when what that promises to save until the next time exceeds what the last time cost.
template <int Dim>
class LoadBalance {
 public:
  /// `interval`: repartition every so many steps, needed or not (a test's wish); 0: by measurement.
  LoadBalance(const PartitionRules<Dim>& rules, GlobalIndex interval)
      : rules_(rules), interval_(interval)
  {
  }

  /// After every step. Collective.
  void look(Stepper<Dim>& stepper);

  GlobalIndex repartitions() const { return repartitions_; }
  /// Particles of the fullest rank over the mean, averaged over the checks.
  double mean_imbalance() const { return checks_ > 0 ? imbalance_sum_ / double(checks_) : 1.0; }
  /// The same of the time of work.
  double mean_work_imbalance() const { return checks_ > 0 ? work_sum_ / double(checks_) : 1.0; }

 private:
  void observe(const Stepper<Dim>& stepper);
  bool is_due(const Stepper<Dim>& stepper);
  /// Returns whether the borders have moved.
  bool move_borders(Stepper<Dim>& stepper);

  PartitionRules<Dim> rules_;
  GlobalIndex interval_;
  GlobalIndex repartitions_ = 0;
  GlobalIndex last_ = 0;        ///< step of the last repartition
  GlobalIndex not_before_ = 0;  ///< step of the next attempt, after one that promised too little
  int checks_above_ = 0;        ///< in a row
  double particle_cost_ = 1;    ///< of this rank over the mean
  double cost_ = 0;             ///< s, of the last repartition
  GlobalIndex checks_ = 0;
  double imbalance_sum_ = 0, work_sum_ = 0;
};

}  // namespace mpm
