#pragma once
/// Moves the borders between ranks when the work has moved.

#include <mpm/parallel/partition.hpp>
#include <mpm/stepping/formulation.hpp>

namespace mpm {

/// Work is counted, not timed, so that the same input on the same ranks gives the same bits. The
/// borders move when the busiest rank has been above the mean by more than a bound in several
/// checks, and when what that promises to save until the next time exceeds what a move costs.
template <int Dim>
class LoadBalance {
 public:
  /// `interval`: repartition every so many steps, needed or not (a test's wish); 0: when it pays.
  LoadBalance(const PartitionRules<Dim>& rules, GlobalIndex interval)
      : rules_(rules), interval_(interval)
  {
  }

  /// After every step. Collective.
  void look(Formulation<Dim>& formulation);

  GlobalIndex repartitions() const { return repartitions_; }
  /// Particles of the fullest rank over the mean, averaged over the checks.
  double mean_imbalance() const { return checks_ > 0 ? imbalance_sum_ / double(checks_) : 1.0; }
  /// The same of the work.
  double mean_work_imbalance() const { return checks_ > 0 ? work_sum_ / double(checks_) : 1.0; }
  void archive(Archive& archive);

 private:
  void observe(const Agreed& agreed);
  bool is_due(const Formulation<Dim>& formulation);
  /// Returns whether the borders have moved.
  bool move_borders(Formulation<Dim>& formulation);

  PartitionRules<Dim> rules_;
  GlobalIndex interval_;
  GlobalIndex repartitions_ = 0;
  GlobalIndex last_ = 0;          ///< step of the last repartition
  GlobalIndex not_before_ = 0;    ///< step of the next attempt, after one that promised too little
  GlobalIndex checks_above_ = 0;  ///< in a row
  GlobalIndex checks_ = 0;
  double imbalance_sum_ = 0, work_sum_ = 0;
};

}  // namespace mpm
