#include <mpm/parallel/session.hpp>
#include <mpm/stepping/load_balance.hpp>

#include <algorithm>

namespace mpm {

namespace {

constexpr double bound = 1.03;
constexpr GlobalIndex checks_in_a_row = 8;
/// Steps until the next attempt after one that did not pay.
constexpr GlobalIndex steps_of_patience = 500;
/// Steps that a gain is counted for at least.
constexpr GlobalIndex shortest_horizon = 1000;
/// What a move costs, in steps: choosing the borders, sending, sorting, finding the shared nodes,
/// forming the sums anew. 8.6 with 80,000 particles on each of two ranks.
constexpr double steps_for_a_move = 10;

template <int Dim>
struct Choice {
  Partition<Dim> next;
  double imbalance_now;  ///< of the same loads under the present map
};

/// What the present work asks for. Collective.
template <int Dim>
Choice<Dim> present_choice(const Formulation<Dim>& formulation, const PartitionRules<Dim>& rules)
{
  const Decomposition<Dim>& now = formulation.decomposition();
  WorkMap<Dim> work(now.geometry(), now.ranks());
  formulation.visit_work([&](const IndexVec<Dim>& cell, double amount) { work.add(cell, amount); });
  work.sum_over_ranks(now.comm());
  const auto loads_under = [&](const Ownership<Dim>& ownership) {
    std::vector<double> loads(ownership.ranks(), 0.0);
    formulation.visit_work([&](const IndexVec<Dim>& cell, double amount) {
      loads[ownership.owner_of_cell(cell)] += amount;
    });
    sum_over_ranks(now.comm(), loads);
    return loads;
  };
  return {choose_partition<Dim>(now.geometry(), now.ranks(), rules, work, loads_under,
                                &now.ownership()),
          imbalance_of(loads_under(now.ownership()))};
}

}  // namespace

template <int Dim>
void LoadBalance<Dim>::look(Formulation<Dim>& formulation)
{
  if (formulation.decomposition().ranks() == 1 || !formulation.can_repartition()) return;
  if (formulation.steps() % Formulation<Dim>::steps_between_checks == 0)
    observe(formulation.agreed());
  if (!is_due(formulation)) return;
  checks_above_ = 0;
  if (!move_borders(formulation)) not_before_ = formulation.steps() + steps_of_patience;
}

template <int Dim>
void LoadBalance<Dim>::observe(const Agreed& agreed)
{
  imbalance_sum_ += agreed.imbalance();
  work_sum_ += agreed.work_imbalance();
  ++checks_;
}

template <int Dim>
bool LoadBalance<Dim>::is_due(const Formulation<Dim>& formulation)
{
  if (interval_ > 0) return formulation.steps() % interval_ == 0;
  if (formulation.steps() % Formulation<Dim>::steps_between_checks != 0) return false;
  checks_above_ = formulation.agreed().work_imbalance() > bound ? checks_above_ + 1 : 0;
  return checks_above_ >= checks_in_a_row && formulation.steps() >= not_before_;
}

template <int Dim>
bool LoadBalance<Dim>::move_borders(Formulation<Dim>& formulation)
{
  const Choice<Dim> choice = present_choice(formulation, rules_);
  if (interval_ == 0) {
    const double saved = choice.imbalance_now - choice.next.imbalance();  // of the mean's work
    const GlobalIndex horizon = std::max(shortest_horizon, formulation.steps() - last_);
    if (saved * double(horizon) < steps_for_a_move) return false;
  }
  formulation.repartition(choice.next.ownership);
  last_ = formulation.steps();
  ++repartitions_;
  return true;
}

template <int Dim>
void LoadBalance<Dim>::archive(Archive& archive)
{
  archive.value("repartitions", repartitions_);
  archive.value("last", last_);
  archive.value("not_before", not_before_);
  archive.value("checks_above", checks_above_);
  archive.value("checks", checks_);
  archive.value("imbalance_sum", imbalance_sum_);
  archive.value("work_sum", work_sum_);
}

template class LoadBalance<2>;
template class LoadBalance<3>;

}  // namespace mpm
