#pragma once
/// The explicit step with weights in the present configuration: particles move over a grid that
/// forgets.

#include <mpm/stepping/formulation.hpp>
#include <mpm/stepping/update_order.hpp>

#include <memory>
#include <vector>

namespace mpm {

/// A step has no collective: what all ranks must know they agree on every `steps_between_checks`
/// steps.
template <int Dim>
class UpdatedLagrangian final : public Formulation<Dim> {
 public:
  struct Setup {
    std::unique_ptr<Transfer<Dim>> transfer;
    OneOf<UpdateOrderRow> order;
    std::vector<Body<Dim>> bodies;
    Slots<Dim> slots{};
    double mass_cut = 0;  ///< kg; nodes with less are not active
    StepExtras extras{};
  };

  UpdatedLagrangian(Decomposition<Dim> decomposition, Setup setup);

  void step(double dt) override;
  void check() override;
  const Agreed& agreed() const override { return agreed_; }

  double time() const override { return time_; }
  GlobalIndex steps() const override { return steps_; }
  const std::vector<Body<Dim>>& bodies() const override { return setup_.bodies; }
  const Decomposition<Dim>& decomposition() const override { return exchange_->decomposition(); }
  LocalIndex active_nodes() const override { return grid().active_nodes(); }
  Carried<Dim> carried() const override;
  double stress_moment() const override { return setup_.order->stress_moment; }
  Slots<Dim>& slots() override { return setup_.slots; }
  double largest_step() const override { return setup_.slots.largest_step(); }

  bool can_repartition() const override { return true; }
  GlobalIndex repartition(const Ownership<Dim>& ownership) override;
  void visit_work(const std::function<void(const IndexVec<Dim>&, double)>& visit) const override;

  Counters counters() const override;
  std::size_t bytes() const override;
  /// Loading: into a formulation set up as the saved one was, on the same part of the grid.
  void archive(Archive& archive) override;
  void begin_loading(const Ownership<Dim>& ownership) override;

  const GridTopology<Dim>& grid() const { return exchange_->topology(); }
  const std::vector<NodeFields<Dim>>& fields() const { return fields_; }

 private:
  void take_own_particles(Archive& archive);
  void connect(Decomposition<Dim> decomposition);
  void sort_and_activate();
  Step<Dim> next_step();
  Counters counters_of_exchange() const;

  Setup setup_;
  StepFunction<Dim> step_;
  std::unique_ptr<Exchange<Dim>> exchange_;
  std::vector<NodeFields<Dim>> fields_;
  double time_ = 0;
  GlobalIndex steps_ = 0;
  Agreed agreed_;
  GlobalIndex checked_ = 0;  ///< step of the last check
  Counters counters_;        ///< without those of the present exchange; may be negative
};

}  // namespace mpm
